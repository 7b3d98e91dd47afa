#include "benchmarks/cli/result_output.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "benchmarks/base/interrupt.hpp"

namespace hullbench::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& name, int error) {
  throw std::runtime_error("cannot write " + name + ": " + std::generic_category().message(error));
}

void write_all(int file, std::string_view bytes, const std::string& name) {
  while (!bytes.empty()) {
    throw_if_interrupted();
    const ssize_t count = ::write(file, bytes.data(), bytes.size());
    if (count < 0 && errno != EINTR) fail(name, errno);
    if (count > 0) bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

void write_file(const std::string& file, int flags, std::string_view bytes, const std::string& name) {
  const int descriptor = ::open(file.c_str(), flags | O_WRONLY | O_CLOEXEC, 0666);
  if (descriptor < 0) fail(name, errno);
  try {
    write_all(descriptor, bytes, name);
  } catch (...) {
    ::close(descriptor);
    throw;
  }
  // Some file systems say only now that there was no room.
  if (::close(descriptor) != 0) fail(name, errno);
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
  if (fs::is_directory(target)) fail(path, EISDIR);
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  const bool replaces = !fs::exists(target) || fs::is_regular_file(target);
  if (::access(replaces ? folder.c_str() : target.c_str(), W_OK) != 0) fail(path, errno);
}

void write_result(const std::string& path, std::string_view bytes) {
  if (path.empty()) return write_all(STDOUT_FILENO, bytes, "standard output");
  const fs::path target = behind_links(path);
  if (fs::exists(target) && !fs::is_regular_file(target)) return write_file(target, 0, bytes, path);
  const std::string unfinished = target.string() + ".unfinished-" + std::to_string(::getpid());
  try {
    write_file(unfinished, O_CREAT | O_TRUNC, bytes, path);
    fs::rename(unfinished, target);
  } catch (...) {
    std::error_code ignored;
    fs::remove(unfinished, ignored);
    throw;
  }
}

}  // namespace hullbench::cli
