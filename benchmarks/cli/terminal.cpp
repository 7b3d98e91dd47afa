#include "benchmarks/cli/terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstddef>
#include <iostream>
#include <utility>

namespace hullbench::cli {

run::Progress make_progress(std::vector<run::ProgressSection> sections) {
  winsize size{};
  const bool known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  const std::size_t width = known ? size.ws_col : 80;
  return {std::cerr, is_terminal(), width, std::move(sections)};
}

}  // namespace hullbench::cli
