// Where a command runs.
#pragma once

#include <unistd.h>

#include <ostream>
#include <string>

namespace polylidar::tool {

class VectorFormats;

/// What a command says goes to `err`; its result to standard output or a file.
struct Surroundings {
  std::string program;    ///< the name in front of what is said
  std::ostream& err;      ///< notes and progress
  bool terminal = false;  ///< whether the last line of `err` can be rewritten, as progress is
  const VectorFormats* vector_formats = nullptr;  ///< what only GDAL reads and writes; null: nothing does
};

/// Whether standard error is a terminal.
inline bool is_terminal() {
  return ::isatty(STDERR_FILENO) == 1;
}

}  // namespace polylidar::tool
