// Files of parts: what is written is read again, and no byte of one can be missing or wrong.
#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/complaint.hpp"
#include "tests/point_file_texts.hpp"
#include "tests/temporary_folder.hpp"
#include "tool/hull/shard_file.hpp"
#include "tool/points/point_file.hpp"
#include "tool/program/result_output.hpp"

namespace polylidar::tool {
namespace {

using hullbench::testing::bytes_of;
using hullbench::testing::complaint_of;

ShardFile example() {
  ShardFile file;
  file.shard.shard = {2, 7};
  file.shard.options = {.alpha = 0.25, .max_perimeter = 3.5, .detail = 2, .fill_single_triangles = true};
  file.shard.source_points = 50'000'000'000;
  file.shard.source_checksum = 0xFEDCBA9876543210;
  file.shard.box = {{-1.5, 2}, {1e9, 3}};
  file.shard.cells_per_length = 24;
  file.shard.points = {{1, 2}, {-1.5, 2.75}, {1e9, 3}, {0.1, 2.5}};
  file.shard.numbers = {0, 1, 127, 49'999'999'999};
  file.shard.uncertain = {1, 0, 0, 1};
  file.crs = {.epsg = 25832, .is_geographic = false, .is_given = true, .wkt = "PROJCS[]"};
  return file;
}

/// The same by the table of the header's description, and by nothing of the writer's.
std::string bytes_of_example() {
  std::string bytes = "polypart" + bytes_of(1U) + bytes_of(2U) + bytes_of(7U) + bytes_of(1U + 4 + 8 + 16) +
                      bytes_of(0.25) + bytes_of(0.0) + bytes_of(3.5) + bytes_of(2.0) +
                      bytes_of(std::uint64_t{50'000'000'000}) + bytes_of(std::uint64_t{0xFEDCBA9876543210}) +
                      bytes_of(-1.5) + bytes_of(2.0) + bytes_of(1e9) + bytes_of(3.0) + bytes_of(24.0) +
                      bytes_of(std::uint64_t{4}) + bytes_of(25832U) + bytes_of(2U) + bytes_of(8U) +
                      "PROJCS[]";
  bytes += "\x01" + bytes_of(1.0) + bytes_of(2.0);
  bytes += std::string(1, '\0') + bytes_of(-1.5) + bytes_of(2.75);
  bytes += "\xFA\x01" + bytes_of(1e9) + bytes_of(3.0);  // 2 * 125
  // 2 * (49,999,999,999 - 128) + 1 = 99,999,999,743
  std::string step;
  for (std::uint64_t rest = 99'999'999'743; rest > 0; rest /= 128) {
    step += static_cast<char>(rest % 128 + (rest >= 128 ? 128 : 0));
  }
  bytes += step + bytes_of(0.1) + bytes_of(2.5);
  std::uint64_t hash = 14695981039346656037U;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211U;
  return bytes + bytes_of(hash);
}

class ShardFileTest : public ::testing::Test {
 protected:
  std::string path() const { return (folder_.path() / "part").string(); }
  std::string complaint(const std::string& bytes) const {
    write_result(path(), bytes);
    return complaint_of<PointFileError>([&] { read_shard_file(path()); });
  }
  std::string written(const ShardFile& file) const {
    write_shard_file(path(), file);
    std::ifstream stream(path(), std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

 private:
  hullbench::testing::TemporaryFolder folder_;
};

void expect_same(const ShardFile& read, const ShardFile& file) {
  EXPECT_EQ(read.shard.shard, file.shard.shard);
  EXPECT_EQ(read.shard.options, file.shard.options);
  EXPECT_EQ(read.shard.source_points, file.shard.source_points);
  EXPECT_EQ(read.shard.source_checksum, file.shard.source_checksum);
  EXPECT_EQ(read.shard.box, file.shard.box);
  EXPECT_EQ(read.shard.cells_per_length, file.shard.cells_per_length);
  EXPECT_EQ(read.shard.points, file.shard.points);
  EXPECT_EQ(read.shard.numbers, file.shard.numbers);
  EXPECT_EQ(read.shard.uncertain, file.shard.uncertain);
  EXPECT_EQ(read.crs, file.crs);
}

TEST_F(ShardFileTest, HasTheBytesOfItsDescription) {
  EXPECT_EQ(written(example()), bytes_of_example());
  expect_same(read_shard_file(path()), example());
  const ShardFile empty;
  written(empty);
  expect_same(read_shard_file(path()), empty);
}

TEST_F(ShardFileTest, NoByteMayBeMissingOrMore) {
  const std::string bytes = bytes_of_example();
  for (std::size_t size = 1; size < bytes.size(); ++size) {
    const std::string said = complaint(bytes.substr(0, size));
    EXPECT_NE(said.find(size < 8 ? "it is no part of a hull" : "it is cut short"), std::string::npos)
        << size << said;
  }
  EXPECT_NE(complaint(bytes + "a").find("it is damaged"), std::string::npos);
}

TEST_F(ShardFileTest, NoByteMayBeAnother) {
  const std::string bytes = bytes_of_example();
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (const unsigned bit : {0U, 7U}) {
      std::string other = bytes;
      other[i] = static_cast<char>(static_cast<unsigned char>(other[i]) ^ 1U << bit);
      EXPECT_NE(complaint(other), "nothing") << i;
    }
  }
}

// A header that promises more than the file has gets no memory for it.
TEST_F(ShardFileTest, ALyingHeaderIsRefused) {
  const auto lie = [&](std::size_t at, const std::string& value) {
    std::string bytes = bytes_of_example();
    return complaint(bytes.replace(at, value.size(), value));
  };
  for (const std::uint64_t count : {std::uint64_t{5}, std::uint64_t{1} << 40U, ~std::uint64_t{0}}) {
    EXPECT_NE(lie(112, bytes_of(count)).find("it is cut short"), std::string::npos) << count;
  }
  EXPECT_NE(lie(128, bytes_of(~0U)).find("it is damaged"), std::string::npos);
  EXPECT_NE(lie(128, bytes_of(1000U)).find("it is cut short"), std::string::npos);
  EXPECT_NE(lie(8, bytes_of(2U)).find("it is a part of version 2, and this program reads version 1"),
            std::string::npos);
  EXPECT_NE(lie(140, std::string(20, '\xFF')).find("it is damaged"), std::string::npos);
  EXPECT_NE(complaint("x,y\n1,2\n3,4\n").find("it is no part of a hull"), std::string::npos);
}

}  // namespace
}  // namespace polylidar::tool
