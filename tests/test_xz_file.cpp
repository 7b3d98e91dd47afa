// Files compressed by xz: their content, and what is said of those that are none.
#include <gtest/gtest.h>

#include <cstddef>
#include <string>

#include "benchmarks/base/names.hpp"
#include "benchmarks/record/xz_file.hpp"
#include "benchmarks/report/report.hpp"
#include "invented_run.hpp"
#include "temporary_folder.hpp"
#include "tests/complaint.hpp"
#include "tests/program.hpp"

namespace hullbench::testing {
namespace {

/// What `xz -9` (5.4.1) makes of 12500 lines "0123456789abcde".
constexpr const char* kCompressed =
    "fd377a585a000004e6d6b446020021011c00000010cf58cce30d3f00735d00180c42926a67bc0ed1332ce4cc4229c04f0e56d5ff"
    "e29f82c4ef0eb81a60234a23d1882b5a45f7da9cb6bf26be6303bae2291e7d4672b46f718946104a45fc204e66542cf98005d05f"
    "3451415004621a9abfe726547bbcd03f55a212be1544f4eb8bd25686556448502e543c2c2b507efa7d00000025534d0fe8d7eff5"
    "00018f01c09a0c004cc7af3bb1c467fb020000000004595a";

std::string bytes_of_hex(const std::string& hex) {
  std::string bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2)
    bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  return bytes;
}

/// More than a decoder's buffer holds.
std::string lines(std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += "0123456789abcde\n";
  return text;
}

class XzFile : public ::testing::Test {
 protected:
  fs::path file() const { return folder_.path() / "runs.jsonl.xz"; }

  /// What is read of a file with these bytes.
  std::string content(const std::string& bytes) const {
    write_text(file(), bytes);
    return record::read_xz_file(file());
  }

  /// What is said of a file with these bytes, or of the file as it is there.
  std::string complaint() const {
    return complaint_of([&] { record::read_xz_file(file()); });
  }
  std::string complaint(const std::string& bytes) const {
    write_text(file(), bytes);
    return complaint();
  }

  std::string not_whole() const { return file().string() + " is not a whole xz file; get it anew."; }

  const std::string good_ = bytes_of_hex(kCompressed);
  TemporaryFolder folder_;
};

TEST_F(XzFile, GivesItsContent) {
  EXPECT_EQ(content(good_), lines(12500));
}

// xz takes files that stand behind one another for one file.
TEST_F(XzFile, OfTwoFilesJoinedHasBothContents) {
  EXPECT_EQ(content(good_ + good_), lines(25000));
}

TEST_F(XzFile, CutShortAnywhereIsASentence) {
  for (std::size_t size = 0; size < good_.size(); ++size)
    EXPECT_EQ(complaint(good_.substr(0, size)), not_whole()) << size;
}

TEST_F(XzFile, DamagedAnywhereIsASentence) {
  for (std::size_t place = 0; place < good_.size(); ++place) {
    std::string damaged = good_;
    damaged[place] = static_cast<char>(damaged[place] ^ 1);
    EXPECT_EQ(complaint(damaged), not_whole()) << place;
  }
}

TEST_F(XzFile, WithSomethingElseBehindItIsASentence) {
  EXPECT_EQ(complaint(good_ + "{}\n"), not_whole());
}

TEST_F(XzFile, ThatIsNoneIsASentence) {
  EXPECT_EQ(complaint("{\"schema_version\": 1}\n"), not_whole());
}

TEST_F(XzFile, ThatIsMissingOrAFolderIsASentence) {
  EXPECT_EQ(complaint(), "Cannot read " + file().string() + ".");
  fs::create_directory(file());
  EXPECT_EQ(complaint(), "Cannot read " + file().string() + ".");
}

class CompressedRun : public ::testing::Test {
 protected:
  void SetUp() override {
    // It compresses the records of a reference run (results/keep_reference.sh).
    if (const std::string why = missing({"xz"}); !why.empty()) GTEST_SKIP() << why;
    write_invented_run(run_, {2000, 64000});
  }

  /// Puts runs.jsonl.xz in the place of runs.jsonl.
  void compress() const {
    ASSERT_EQ(run_program({"xz", "--check=crc64", (run_ / "runs.jsonl").string()}).code, 0);
    ASSERT_FALSE(fs::exists(run_ / "runs.jsonl"));
  }

  TemporaryFolder folder_;
  const fs::path run_ = folder_.path() / "run";
};

TEST_F(CompressedRun, HasTheSameReport) {
  const json before = report::make_report(run_);
  ASSERT_FALSE(before.at("runs").empty());
  compress();
  EXPECT_EQ(report::make_report(run_), before);
}

TEST_F(CompressedRun, ThatIsDamagedIsASentenceWithTheFile) {
  compress();
  const fs::path file = run_ / "runs.jsonl.xz";
  std::string bytes = read_text(file);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  write_text(file, bytes);
  EXPECT_EQ(complaint_of([&] { report::make_report(run_); }),
            file.string() + " is not a whole xz file; get it anew.");
}

}  // namespace
}  // namespace hullbench::testing
