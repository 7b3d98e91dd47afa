// JSON lines files: one JSON document a line, appended and flushed as it happens, so that a program that is
// killed loses at most the line it was writing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"

namespace hullbench::record {

/// What a JSON lines file holds.
struct JsonLines {
  std::vector<json> lines;
  std::vector<std::size_t> numbers;  ///< of each, from 1 on: empty lines count
  /// The bytes after the last line feed, when the writer was interrupted in the middle of a line; empty
  /// otherwise. They are no line, even when they happen to be JSON: a number cut short is still a number.
  std::string torn;
  /// Number of bytes up to and with the last line feed: where the next line belongs.
  std::uintmax_t complete_bytes = 0;
};

/// What is said to do with a line that cannot be read.
inline constexpr const char* kDeleteLine = "delete the line to keep the others";

/// Reads `path`, compressed by xz when its name ends in .xz. A file that does not exist has no lines; empty
/// lines are skipped. Throws ConfigurationError naming the file and the line when it cannot be read or when a
/// complete line is not JSON.
JsonLines load_json_lines(const fs::path& path);

/// Appends lines to a file. A torn last line is cut off when the file is opened, or the first new line would
/// be glued to it and both lost.
class JsonLinesWriter {
 public:
  /// Opens or makes `path`. Throws std::runtime_error naming the file when it cannot be written.
  explicit JsonLinesWriter(const fs::path& path);

  /// Writes `json` as one line and hands it to the operating system. NaN and infinities become null. Throws
  /// std::runtime_error naming the file when it cannot be written (a full disk).
  void append(const json& json);

 private:
  fs::path path_;
  std::ofstream out_;
};

}  // namespace hullbench::record
