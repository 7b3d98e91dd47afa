// Where a result goes: to standard output or into a file, whole or not at all.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace polylidar::tool {

/// Where `path` leads: a link stays, and the file that it names gets the result, be it there or not.
std::filesystem::path behind_links(const std::filesystem::path& path);

/// Beside `target`, of what becomes it when it is whole; of this process alone.
std::filesystem::path unfinished_path(const std::filesystem::path& target);

/// Whether `path` is standard output: empty, - or its device, as a file that it was redirected to gets the
/// result where it stands.
bool is_standard_output(const std::string& path);

/// Throws std::runtime_error when no file can be written at `path`, which would otherwise be known only when
/// the result is there. Nothing to check for standard output.
void check_output_place(const std::string& path);

/// Gives an open file the mode and, where that is allowed, the owner of the file that it takes the place of,
/// if there is one: who may read that one may read the new one, and nobody else, as far as the system lets
/// this user set it. Throws std::runtime_error, with the `name` of the result, when the system refuses.
void keep_owner_and_mode(int file, const std::filesystem::path& replaced, const std::string& name);

/// A result that is written piece by piece: to standard output (an empty path, or -), or into a file of
/// another name that finish() renames to `path`, so that nobody ever sees half a result. It gets the mode
/// and, where that is allowed, the owner of the file that it replaces. What is there and is no file (a
/// device, a named pipe) is written to. All functions throw std::runtime_error when the system refuses (disk
/// full, pipe closed), and Interrupted when interrupted. Standard output: SIGPIPE must be ignored.
class ResultOutput {
 public:
  explicit ResultOutput(const std::string& path);
  /// Removes an unfinished file.
  ~ResultOutput();
  ResultOutput(const ResultOutput&) = delete;
  ResultOutput& operator=(const ResultOutput&) = delete;

  void write(std::string_view bytes);
  void finish();

 private:
  /// Closes the file, and removes it if it is unfinished.
  void discard();

  std::string name_;        ///< for messages
  std::string target_;      ///< the file that the result becomes; empty: what is written to is there already
  std::string unfinished_;  ///< its name until then
  int file_ = -1;           ///< -1: closed
};

/// Writes `bytes` as ResultOutput does.
void write_result(const std::string& path, std::string_view bytes);

}  // namespace polylidar::tool
