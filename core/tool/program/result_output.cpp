#include "tool/program/result_output.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
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

}  // namespace

bool is_standard_output(const std::string& path) {
  return path.empty() || path == "-" || path == "/dev/stdout";
}

fs::path behind_links(const fs::path& path) {
  constexpr int kMostLinks = 40;
  std::error_code error;
  fs::path target = path;
  for (int links = 0; links < kMostLinks && fs::is_symlink(target, error); ++links) {
    // What a link of /proc/self/fd names need not have a path.
    if (fs::exists(target, error) && !fs::is_regular_file(target, error)) break;
    target = target.parent_path() / fs::read_symlink(target, error);
  }
  return target;
}

fs::path unfinished_path(const fs::path& target) {
  constexpr std::size_t kLongestName = 255;  // bytes, on nearly all file systems
  const std::string ending = ".unfinished-" + std::to_string(::getpid());
  std::string name = target.filename().string();
  name.resize(std::min(name.size(), kLongestName - ending.size()));
  return target.parent_path() / (name + ending);
}

void check_output_place(const std::string& path) {
  if (is_standard_output(path)) return;
  const fs::path target = behind_links(path);
  if (::access(target.c_str(), F_OK) != 0 && errno == ENAMETOOLONG) fail(path, errno);
  std::error_code ignored;  // where a folder on the way is closed, access() says so
  if (fs::is_directory(target, ignored)) fail(path, EISDIR);
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  const bool exists = fs::exists(target, ignored);
  if (exists && ::access(target.c_str(), W_OK) != 0) fail(path, errno);
  const bool replaces = !exists || fs::is_regular_file(target, ignored);
  if (replaces && ::access(folder.c_str(), W_OK) != 0) fail(path, errno);
}

void keep_owner_and_mode(int file, const fs::path& replaced, const std::string& name) {
  struct ::stat old = {};
  struct ::stat made = {};
  if (::stat(replaced.c_str(), &old) != 0 || !S_ISREG(old.st_mode)) return;
  if (::fstat(file, &made) != 0) fail(name, errno);
  // A file system without owners and modes has the same for all files, and refuses to set them.
  const bool has_owner = made.st_uid == old.st_uid && made.st_gid == old.st_gid;
  const bool is_owner_kept = has_owner || ::fchown(file, old.st_uid, old.st_gid) == 0;
  constexpr ::mode_t kOfGroup = S_IRWXG;
  constexpr ::mode_t kOfAll = S_IRWXU | S_IRWXG | S_IRWXO;
  // The group of this user is another one.
  const ::mode_t mode = old.st_mode & (is_owner_kept ? kOfAll : kOfAll & ~kOfGroup);
  if ((made.st_mode & kOfAll) != mode && ::fchmod(file, mode) != 0) fail(name, errno);
}

ResultOutput::ResultOutput(const std::string& path)
    : name_(is_standard_output(path) ? "standard output" : path) {
  if (is_standard_output(path)) {
    file_ = STDOUT_FILENO;
    return;
  }
  const std::string target = behind_links(path).string();
  std::error_code ignored;
  if (fs::exists(target, ignored) && !fs::is_regular_file(target, ignored)) {
    file_ = open_file(target, 0, name_);
    return;
  }
  const std::string unfinished = unfinished_path(target).string();
  file_ = open_file(unfinished, O_CREAT | O_TRUNC, name_);
  target_ = target;
  unfinished_ = unfinished;
  try {
    keep_owner_and_mode(file_, target, name_);
  } catch (...) {
    discard();
    throw;
  }
}

ResultOutput::~ResultOutput() {
  discard();
}

void ResultOutput::discard() {
  if (file_ != -1 && file_ != STDOUT_FILENO) ::close(file_);
  file_ = -1;
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
