#include "tool/program/result_output.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "tool/program/interrupt.hpp"

namespace polylidar::tool {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& name, int error) {
  throw std::runtime_error("cannot write " + name + ": " + std::generic_category().message(error));
}

int open_file(const std::string& file, int flags, const std::string& name) {
  int descriptor = -1;
  // A named pipe is waited for.
  while ((descriptor = ::open(file.c_str(), flags | O_WRONLY | O_CLOEXEC, 0666)) < 0 && errno == EINTR) {
    throw_if_interrupted();
  }
  if (descriptor < 0) fail(name, errno);
  return descriptor;
}

/// Where `path` leads: a link stays, and the file that it names gets the result.
fs::path behind_links(const std::string& path) {
  std::error_code error;
  const fs::path target = fs::weakly_canonical(path, error);
  return error ? fs::path(path) : target;
}

}  // namespace

void check_output_place(const std::string& path) {
  if (path.empty()) return;
  const fs::path target = behind_links(path);
  std::error_code ignored;  // where a folder on the way is closed, access() says so
  if (fs::is_directory(target, ignored)) fail(path, EISDIR);
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  const bool replaces = !fs::exists(target, ignored) || fs::is_regular_file(target, ignored);
  if (::access(replaces ? folder.c_str() : target.c_str(), W_OK) != 0) fail(path, errno);
}

ResultOutput::ResultOutput(const std::string& path) : name_(path.empty() ? "standard output" : path) {
  if (path.empty()) {
    file_ = STDOUT_FILENO;
    return;
  }
  const std::string target = behind_links(path).string();
  std::error_code ignored;
  if (fs::exists(target, ignored) && !fs::is_regular_file(target, ignored)) {
    file_ = open_file(target, 0, name_);
    return;
  }
  const std::string unfinished = target + ".unfinished-" + std::to_string(::getpid());
  file_ = open_file(unfinished, O_CREAT | O_TRUNC, name_);
  target_ = target;
  unfinished_ = unfinished;
}

ResultOutput::~ResultOutput() {
  if (file_ != -1 && file_ != STDOUT_FILENO) ::close(file_);
  std::error_code ignored;
  if (!unfinished_.empty()) fs::remove(unfinished_, ignored);
}

void ResultOutput::write(std::string_view bytes) {
  while (!bytes.empty()) {
    throw_if_interrupted();
    const ssize_t count = ::write(file_, bytes.data(), bytes.size());
    if (count < 0 && errno != EINTR) fail(name_, errno);
    if (count > 0) bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

void ResultOutput::finish() {
  const int file = std::exchange(file_, -1);
  // Some file systems say only now that there was no room.
  if (file != STDOUT_FILENO && ::close(file) != 0) fail(name_, errno);
  if (unfinished_.empty()) return;
  std::error_code error;
  fs::rename(unfinished_, target_, error);
  if (error) fail(name_, error.value());
  unfinished_.clear();
}

void write_result(const std::string& path, std::string_view bytes) {
  ResultOutput output(path);
  output.write(bytes);
  output.finish();
}

}  // namespace polylidar::tool
