#include "tool/program/surroundings.hpp"

#include <unistd.h>

namespace polylidar::tool {

bool is_terminal() {
  return ::isatty(STDERR_FILENO) == 1;
}

}  // namespace polylidar::tool
