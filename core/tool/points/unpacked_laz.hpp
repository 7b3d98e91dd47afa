// A LAZ file, unpacked by somebody else's program.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

namespace polylidar::tool::point_files {

/// The first of the programs laszip and las2las (LAStools) that is in a folder of PATH; nothing when none is.
std::optional<std::string> find_laz_program();

/// The program at work: the LAS file comes out of file().
class UnpackedLaz {
 public:
  /// Throws std::runtime_error when the program cannot be started.
  UnpackedLaz(const std::string& program, const std::string& path);
  /// Ends the program if it still runs.
  ~UnpackedLaz();
  UnpackedLaz(const UnpackedLaz&) = delete;
  UnpackedLaz& operator=(const UnpackedLaz&) = delete;

  /// A descriptor to read from; who reads closes it.
  int file() const { return file_; }
  /// Waits for the program's end and says whether it did its work, or would have if we had gone on reading.
  bool succeeded();

 private:
  pid_t process_ = -1;
  int file_ = -1;
};

}  // namespace polylidar::tool::point_files
