#include "benchmarks/run/row_store.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <exception>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/files.hpp"
#include "benchmarks/record/stored_run.hpp"

namespace hullbench::run {
namespace {

std::string reason(int error) {
  return std::generic_category().message(error);
}

void synchronise(const fs::path& file) {
  const int fd = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  const int failed = fd < 0 ? -1 : ::fsync(fd);
  const int error = errno;
  if (fd >= 0) ::close(fd);
  // Some file systems know no fsync; that is no reason to stop.
  if (failed != 0 && error != EINVAL && error != EROFS) {
    throw std::runtime_error("cannot write " + file.string() + ": " + reason(error));
  }
}

}  // namespace

int try_lock(const fs::path& path) {
  const bool is_folder = fs::is_directory(path);
  const int lock = ::open(path.c_str(), (is_folder ? O_RDONLY : O_RDWR | O_CREAT) | O_CLOEXEC, 0666);
  if (lock < 0 || (is_folder && ::faccessat(AT_FDCWD, path.c_str(), W_OK | X_OK, AT_EACCESS) != 0)) {
    const int error = errno;
    if (lock >= 0) ::close(lock);
    throw not_writable(path, reason(error));
  }
  // A file system without locks is no reason to refuse: the lock only guards against a second harness.
  if (::flock(lock, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return lock;
  ::close(lock);
  return -1;
}

int lock_or_throw(const fs::path& path) {
  const int lock = try_lock(path);
  if (lock < 0) {
    throw ConfigurationError("another hullbench is writing to " + path.string() +
                             "; wait for it or choose another folder with --out");
  }
  return lock;
}

RowStore::RowStore(RowFile where, int lock)
    : where_(std::move(where)), scratch_(fs::absolute(where_.folder) / where_.scratch), lock_(lock) {
  writer_.emplace(where_.folder / where_.name);
  read_rows(where_.folder / where_.name);
  fs::remove_all(scratch_);
  fs::create_directory(scratch_);
}

RowStore::~RowStore() {
  std::error_code ignored;
  fs::remove_all(scratch_, ignored);
  ::close(lock_);
}

void RowStore::read_rows(const fs::path& file) {
  const std::scoped_lock guard(mutex_);
  for (record::RunRecord& row : record::records_of(record::load_json_lines(file), file)) remember(row);
}

const record::RunRecord* RowStore::find_row(const std::string& key) const {
  const std::scoped_lock guard(mutex_);
  const auto found = places_.find(key);
  return found == places_.end() ? nullptr : &rows_[found->second];
}

void RowStore::remember(const record::RunRecord& row) {
  const auto [place, is_new] = places_.emplace(row.*where_.key, rows_.size());
  if (is_new) {
    rows_.push_back(row);
  } else {
    rows_[place->second] = row;
    has_old_rows_ = true;
  }
}

void RowStore::append_row(const record::RunRecord& row) {
  const std::scoped_lock guard(mutex_);
  writer_->append(row);
  remember(row);
}

void RowStore::append_rows(const std::vector<record::RunRecord>& rows) {
  const std::scoped_lock guard(mutex_);
  const bool replaces_another_id = std::ranges::any_of(rows, [&](const record::RunRecord& row) {
    const auto earlier = places_.find(row.*where_.key);
    return earlier != places_.end() && rows_[earlier->second].id != row.id;
  });
  for (const record::RunRecord& row : rows) remember(row);
  if (replaces_another_id) {
    rewrite();
    return;
  }
  for (const record::RunRecord& row : rows) writer_->append(row);
  synchronise(where_.folder / where_.name);
}

void RowStore::compact_rows() {
  const std::scoped_lock guard(mutex_);
  if (has_old_rows_) rewrite();
}

void RowStore::rewrite() {
  const fs::path file = where_.folder / where_.name;
  const fs::path temporary = file.string() + ".new";
  fs::remove(temporary);
  record::JsonLinesWriter writer(temporary);
  for (const record::RunRecord& row : rows_) writer.append(row);
  synchronise(temporary);
  fs::rename(temporary, file);
  writer_.emplace(file);
  has_old_rows_ = false;
}

}  // namespace hullbench::run
