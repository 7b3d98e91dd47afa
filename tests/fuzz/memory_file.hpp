// The bytes of an input where a reader of files finds them, and what it may say of them.
#pragma once

#include <exception>
#include <string>
#include <string_view>

namespace polylidar::fuzz {

/// Says what is wrong and aborts unless it holds.
void expect(bool holds, const char* what);

/// The bytes as a file, or as a pipe, whose length nobody knows, while they fit into one.
class MemoryFile {
 public:
  MemoryFile(std::string_view bytes, bool as_pipe);
  ~MemoryFile();
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const { return "/proc/self/fd/" + std::to_string(file_); }

 private:
  int file_ = -1;
};

/// A refusal is one line of plain text that names the file.
void check_refusal(const std::exception& error, const MemoryFile& file);

}  // namespace polylidar::fuzz
