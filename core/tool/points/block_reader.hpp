// A file or standard input, block by block.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tool/points/gunzip.hpp"
#include "tool/points/point_file.hpp"

namespace polylidar::tool::point_files {

/// Of UTF-8.
inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// Reads from front to back through one block of memory and knows where it is. All functions throw
/// PointFileError when the system refuses to read.
class BlockReader {
 public:
  static constexpr int kEnd = -1;

  /// Opens `path` ("-": standard input), unpacks what gzip compressed and passes over a byte order mark of
  /// UTF-8.
  BlockReader(const std::string& path, const PointFileOptions& options);
  ~BlockReader();
  BlockReader(const BlockReader&) = delete;
  BlockReader& operator=(const BlockReader&) = delete;

  /// The next byte, 0 to 255, or kEnd; `get` goes past it.
  int peek() {
    if (position_ == end_ && !refill()) return kEnd;
    return static_cast<unsigned char>(block_[position_]);
  }
  int get() {
    const int byte = peek();
    if (byte == kEnd) return kEnd;
    if (at_line_end_) ++line_;
    at_line_end_ = byte == '\n';
    ++position_;
    return byte;
  }

  /// The bytes at hand, as many as have been read already; empty at the end only.
  std::string_view ahead();
  /// Waits for more bytes than ahead() has; false when nothing more comes or no more fit.
  bool read_on() { return refill(); }
  /// The next line without its end ("\n" or "\r\n"), until the next call; false at the end. A line that does
  /// not fit into a block is refused.
  bool next_line(std::string_view& line);
  /// The next `size` bytes; false when there are fewer.
  bool read(char* to, std::size_t size);
  /// Past the next `size` bytes; false when there are fewer.
  bool skip(std::uint64_t size);
  /// The `size` bytes at `place` of a file whose remaining() is known, from wherever the reader is, which
  /// stays there; false when there are fewer.
  bool read_at(std::uint64_t place, char* to, std::size_t size);

  /// Calls options().on_progress. Reading does so by itself; what takes long between two reads has to, so
  /// that it can be interrupted.
  void tell_progress() const;

  /// How many bytes follow; nothing when that is not known, as of a pipe.
  std::optional<std::uint64_t> remaining() const;
  /// The number, from 1, of the line that the last byte or line was in.
  std::uint64_t line() const { return line_; }
  const PointFileOptions& options() const { return options_; }

  /// Throws PointFileError with the file's name, or with its name and line().
  [[noreturn]] void fail(const std::string& what) const;
  [[noreturn]] void fail_here(const std::string& what) const;

 private:
  void start();
  bool refill();
  std::size_t read_raw(char* to, std::size_t size);
  std::size_t read_some(char* to, std::size_t size);

  const PointFileOptions& options_;
  std::string name_;
  int file_ = -1;
  std::optional<std::uint64_t> size_;
  std::unique_ptr<Gunzip> gunzip_;  ///< of a file that gzip compressed
  std::unique_ptr<char[]> block_;   ///< none before something is read into it
  std::size_t position_ = 0;        ///< in block_, of the next byte
  std::size_t end_ = 0;             ///< of what block_ holds
  std::uint64_t taken_ = 0;         ///< bytes that the system has given
  std::uint64_t taken_apart_ = 0;   ///< bytes that read_at() has given
  std::uint64_t line_ = 0;
  bool at_line_end_ = true;
};

}  // namespace polylidar::tool::point_files
