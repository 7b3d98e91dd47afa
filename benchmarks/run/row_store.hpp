// Rows in a folder: a file of JSON lines that grows as they happen, so that a later start goes on from there.
#pragma once

#include <cstddef>
#include <deque>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/record/json_lines.hpp"
#include "benchmarks/record/record.hpp"

namespace hullbench::run {

/// Locks a folder, or a file, which is made where it is not there, against a second harness: a descriptor
/// that has the lock until it is closed, however its owner ends. -1 when another process has it. Throws
/// ConfigurationError when it cannot be written to.
int try_lock(const fs::path& path);
/// The same; throws ConfigurationError, too, when another process has it.
int lock_or_throw(const fs::path& path);

/// Where rows are kept.
struct RowFile {
  fs::path folder;                      ///< must be there
  std::string name;                     ///< in the folder
  std::string scratch;                  ///< likewise: a folder for files that live no longer than the store
  std::string record::RunRecord::*key;  ///< what a row is found by, and replaced when there is a newer one
};

/// The rows of a file and what is added to them. Safe from several threads at once.
class RowStore {
 public:
  /// `lock` is a descriptor of lock_or_throw, closed with this object. Reads what an earlier start left, and
  /// cuts off a torn last line. Throws std::runtime_error naming the file when it is damaged otherwise.
  RowStore(RowFile where, int lock);
  ~RowStore();
  RowStore(const RowStore&) = delete;
  RowStore& operator=(const RowStore&) = delete;

  const fs::path& path() const { return where_.folder; }
  /// Made anew, and removed with this object.
  const fs::path& scratch() const { return scratch_; }

  /// Knows the rows of another file too, which stays as it is. Throws as the constructor.
  void read_rows(const fs::path& file);

  /// In the order of the files. Not while another thread appends.
  const std::deque<record::RunRecord>& rows() const { return rows_; }
  /// The row with that key; null when there is none. It stays where it is.
  const record::RunRecord* find_row(const std::string& key) const;

  /// Adds a row, which outlives this process when this returns. One that has the id of an earlier one stays
  /// in the file with it until compact_rows, as every reader takes the last one of an id.
  void append_row(const record::RunRecord& row);
  /// Adds rows, which are on the disk when this returns.
  void append_rows(const std::vector<record::RunRecord>& rows);
  /// Leaves each row once in the file.
  void compact_rows();

 private:
  void remember(const record::RunRecord& row);
  void rewrite();

  RowFile where_;
  fs::path scratch_;
  int lock_;
  mutable std::mutex mutex_;  ///< of all below
  std::deque<record::RunRecord> rows_;
  std::map<std::string, std::size_t> places_;  ///< in rows_, by key
  bool has_old_rows_ = false;                  ///< the file has rows that were replaced
  std::optional<record::JsonLinesWriter> writer_;
};

}  // namespace hullbench::run
