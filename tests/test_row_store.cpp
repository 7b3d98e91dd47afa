// The store of rows, as a run has it (by name) and a search (by id, several files in a folder).
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/record/json_lines.hpp"
#include "benchmarks/run/row_store.hpp"
#include "tests/complaint.hpp"
#include "tests/program.hpp"
#include "tests/temporary_folder.hpp"

namespace hullbench::testing {
namespace {

using record::RunRecord;

RunRecord row_of(const std::string& name, const std::string& id, const std::string& detail = "") {
  RunRecord row;
  row.name = name;
  row.id = id;
  row.detail = detail;
  return row;
}

class RowStoreTest : public ::testing::Test {
 protected:
  run::RowFile file(std::string RunRecord::*key, const std::string& name = "rows.jsonl") const {
    return {folder_.path(), name, "scratch-" + name, key};
  }
  int lock(const std::string& name = "rows.jsonl") const { return run::lock_or_throw(folder_.path() / name); }
  std::size_t lines() const { return record::load_json_lines(folder_.path() / "rows.jsonl").lines.size(); }

  TemporaryFolder folder_;
};

TEST_F(RowStoreTest, ByNameTheLastRowCountsAndAnotherIdLeavesNoTrace) {
  {
    run::RowStore store(file(&RunRecord::name), lock());
    store.append_rows({row_of("a", "1", "first"), row_of("b", "2")});
    store.append_rows({row_of("a", "1", "second")});
    EXPECT_EQ(lines(), 3U) << "every reader takes the last of an id";
    store.append_rows({row_of("b", "3")});
    EXPECT_EQ(lines(), 2U) << "a reader would take the old id for another run";
    store.append_rows({row_of("a", "1", "third")});
  }
  run::RowStore store(file(&RunRecord::name), lock());
  ASSERT_EQ(store.rows().size(), 2U);
  EXPECT_EQ(store.find_row("a")->detail, "third");
  EXPECT_EQ(store.find_row("b")->id, "3");
  EXPECT_EQ(store.find_row("c"), nullptr);
  store.compact_rows();
  EXPECT_EQ(lines(), 2U);
}

TEST_F(RowStoreTest, ByIdRowsOfOneNameAreAllThereAndThoseOfAnotherFileToo) {
  {
    run::RowStore other(file(&RunRecord::id, "other.jsonl"), lock("other.jsonl"));
    other.append_row(row_of("a", "3"));
  }
  run::RowStore store(file(&RunRecord::id), lock());
  const RunRecord* first = nullptr;
  for (int id = 10; id < 2000; ++id) {
    store.append_row(row_of("a", std::to_string(id)));
    if (!first) first = store.find_row("10");
  }
  EXPECT_EQ(store.find_row("10"), first) << "a row stays where it is";
  store.read_rows(folder_.path() / "other.jsonl");
  EXPECT_EQ(store.rows().size(), 1991U);
  EXPECT_EQ(store.find_row("3")->name, "a");
  EXPECT_EQ(lines(), 1990U);
}

TEST_F(RowStoreTest, ATornLineIsCutOffAndADamagedOneNamesItsFile) {
  { run::RowStore(file(&RunRecord::name), lock()).append_row(row_of("a", "1")); }
  const fs::path path = folder_.path() / "rows.jsonl";
  const std::string whole = read_text(path);
  write_text(path, whole + R"({"name": "b)");
  { run::RowStore(file(&RunRecord::name), lock()).append_row(row_of("c", "2")); }
  EXPECT_EQ(lines(), 2U);
  write_text(path, whole + "{}\n");
  expect_complaint([&] { run::RowStore(file(&RunRecord::name), lock()); },
                   path.string() + " is not a run's record");
}

TEST_F(RowStoreTest, HasOneWriterAndAScratchFolderThatGoesWithIt) {
  const fs::path scratch = folder_.path() / "scratch-rows.jsonl";
  fs::create_directories(scratch / "left by a harness that was killed");
  {
    run::RowStore store(file(&RunRecord::name), lock());
    EXPECT_TRUE(fs::is_empty(store.scratch()));
    EXPECT_THROW(lock(), ConfigurationError);
    EXPECT_EQ(run::try_lock(folder_.path() / "rows.jsonl"), -1);
  }
  EXPECT_FALSE(fs::exists(scratch));
  run::RowStore again(file(&RunRecord::name), lock());
}

}  // namespace
}  // namespace hullbench::testing
