#include "tool/points/block_reader.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "tool/program/letter_case.hpp"

namespace polylidar::tool::point_files {
namespace {

constexpr std::size_t kBlockBytes = std::size_t{1} << 20U;
/// Of many files only the beginning is looked at, or what is far behind it.
constexpr std::size_t kFirstBytes = std::size_t{1} << 16U;

std::string reason(int error) {
  return std::generic_category().message(error);
}

}  // namespace

BlockReader::BlockReader(const std::string& path, const PointFileOptions& options)
    : options_(options), name_(path == "-" ? "standard input" : path) {
  const auto open = [&] {
    return path == "-" ? ::dup(STDIN_FILENO) : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  };
  // A named pipe is waited for.
  while ((file_ = open()) < 0 && errno == EINTR) {
    if (options.on_progress) options.on_progress(0, {});
  }
  if (file_ < 0) {
    const int error = errno;
    if (error == ENOENT) throw PointFileError("there is no file " + name_ + " to read points from");
    fail("it cannot be opened: " + reason(error));
  }
  try {
    struct stat status {};
    if (::fstat(file_, &status) == 0) {
      if (S_ISDIR(status.st_mode)) fail("it is a folder; give files, as in FOLDER/*.las");
      // Standard input may be a file that somebody has read from already.
      if (S_ISREG(status.st_mode) && path != "-") size_ = static_cast<std::uint64_t>(status.st_size);
    }
#ifdef POSIX_FADV_SEQUENTIAL
    ::posix_fadvise(file_, 0, 0, POSIX_FADV_SEQUENTIAL);  // the system reads farther ahead
#endif
    start();
  } catch (...) {
    ::close(file_);
    throw;
  }
}

void BlockReader::start() {
  // A coordinate may have any bytes.
  const bool is_raw = options_.format == PointFormat::kRaw;
  if (is_raw && !lower_case(name_).ends_with(".gz")) return;
  if (is_raw && !Gunzip::is_available())
    fail("this was built without zlib and cannot unpack it; give it unpacked");
  if (ahead().starts_with("\x1F\x8B") && Gunzip::is_available()) {
    gunzip_ =
        std::make_unique<Gunzip>(ahead(), [this](char* to, std::size_t size) { return read_raw(to, size); });
    position_ = end_ = 0;
  }
  if (!is_raw && ahead().starts_with(kByteOrderMark)) position_ += kByteOrderMark.size();
}

BlockReader::~BlockReader() {
  ::close(file_);
}

std::size_t BlockReader::read_some(char* to, std::size_t size) {
  if (!gunzip_) return read_raw(to, size);
  try {
    return gunzip_->read(to, size);
  } catch (const GunzipError& error) {
    fail(error.what());
  }
}

std::size_t BlockReader::read_raw(char* to, std::size_t size) {
  constexpr int kMilliseconds = 200;  // so that an interruption just before the wait is seen, too
  for (;;) {
    pollfd wait{file_, POLLIN, 0};
    const int ready = ::poll(&wait, 1, kMilliseconds);
    const ssize_t count = ready > 0 ? ::read(file_, to, size) : -1;
    if (count < 0 && ready != 0 && errno != EINTR) fail("it cannot be read: " + reason(errno));
    taken_ += static_cast<std::uint64_t>(std::max<ssize_t>(count, 0));
    // Also after a signal, so that an interruption is seen while a pipe stays silent.
    tell_progress();
    if (count >= 0) return static_cast<std::size_t>(count);
  }
}

/// Moves what is left to the front of the block and reads behind it. False when nothing more comes.
bool BlockReader::refill() {
  if (!block_) block_ = std::make_unique_for_overwrite<char[]>(kBlockBytes);
  std::memmove(block_.get(), block_.get() + position_, end_ - position_);
  end_ -= position_;
  position_ = 0;
  const std::size_t count = read_some(block_.get() + end_, (taken_ == 0 ? kFirstBytes : kBlockBytes) - end_);
  end_ += count;
  return count > 0;
}

std::string_view BlockReader::ahead() {
  if (position_ == end_) refill();
  return {block_.get() + position_, end_ - position_};
}

bool BlockReader::next_line(std::string_view& line) {
  std::size_t searched = 0;
  for (;;) {
    const char* begin = block_.get() + position_;
    const std::size_t held = end_ - position_;
    const auto* found = static_cast<const char*>(std::memchr(begin + searched, '\n', held - searched));
    if (found != nullptr) {
      line = {begin, static_cast<std::size_t>(found - begin)};
      position_ += line.size() + 1;
      break;
    }
    searched = held;
    if (held == kBlockBytes) {
      ++line_;
      fail_here("the line is longer than " + std::to_string(kBlockBytes) +
                " bytes; write one point a line, or name the right format with --input");
    }
    if (refill()) continue;
    if (held == 0) return false;
    line = {block_.get() + position_, held};
    position_ = end_;
    break;
  }
  ++line_;
  if (line.ends_with('\r')) line.remove_suffix(1);
  return true;
}

bool BlockReader::read(char* to, std::size_t size) {
  const std::size_t held = std::min(size, end_ - position_);
  if (held > 0) std::memcpy(to, block_.get() + position_, held);
  position_ += held;
  for (std::size_t done = held; done < size;) {
    const std::size_t count = read_some(to + done, std::min(size - done, kBlockBytes));
    if (count == 0) return false;
    done += count;
  }
  return true;
}

bool BlockReader::skip(std::uint64_t size) {
  if (size_ && !gunzip_ && size > end_ - position_) {
    const std::uint64_t behind = size - (end_ - position_);  // what has been read
    if (behind > *size_ - std::min(*size_, taken_)) return false;
    if (::lseek(file_, static_cast<off_t>(behind), SEEK_CUR) < 0) fail("it cannot be read: " + reason(errno));
    taken_ += behind;
    position_ = end_;
    return true;
  }
  while (size > 0) {
    const std::uint64_t part = std::min<std::uint64_t>(size, ahead().size());
    if (part == 0) return false;
    position_ += part;
    size -= part;
  }
  return true;
}

bool BlockReader::read_at(std::uint64_t place, char* to, std::size_t size) {
  for (std::size_t done = 0; done < size;) {
    const ssize_t count =
        ::pread(file_, to + done, std::min(size - done, kBlockBytes), static_cast<off_t>(place + done));
    if (count < 0 && errno != EINTR) fail("it cannot be read: " + reason(errno));
    if (count == 0) return false;
    const auto given = static_cast<std::size_t>(std::max<ssize_t>(count, 0));
    done += given;
    taken_apart_ += given;
    tell_progress();
  }
  return true;
}

void BlockReader::tell_progress() const {
  if (!options_.on_progress) return;
  // What was read ahead at the beginning may be read apart again.
  const std::uint64_t taken = taken_ + taken_apart_;
  options_.on_progress(size_ ? std::min(taken, *size_) : taken, size_);
}

std::optional<std::uint64_t> BlockReader::remaining() const {
  if (!size_ || gunzip_) return {};
  return std::max(*size_, taken_) - taken_ + (end_ - position_);
}

void BlockReader::fail(const std::string& what) const {
  throw PointFileError(name_ + ": " + what);
}

void BlockReader::fail_here(const std::string& what) const {
  throw PointFileError(name_ + ", line " + std::to_string(std::max<std::uint64_t>(line_, 1)) + ": " + what);
}

}  // namespace polylidar::tool::point_files
