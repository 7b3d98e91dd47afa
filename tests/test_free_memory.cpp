// How much memory is free, by pretended files of the system.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "tests/temporary_folder.hpp"
#include "tool/program/free_memory.hpp"

namespace hullbench::testing {
namespace {

namespace fs = std::filesystem;

class FreeMemoryTest : public ::testing::Test {
 protected:
  void write(const std::string& file, const std::string& text) const {
    fs::create_directories((folder_.path() / file).parent_path());
    std::ofstream(folder_.path() / file) << text;
  }
  /// A group of version 2 with its limit, what it uses, and what of that the system would give back.
  void group(const std::string& name, const std::string& limit, int used, int cached) const {
    const std::string at = "sys/fs/cgroup/" + name + "/memory.";
    write(at + "max", limit + "\n");
    write(at + "current", std::to_string(used) + "\n");
    write(at + "stat", "anon 1\ninactive_file " + std::to_string(cached) + "\n");
  }
  std::optional<std::size_t> free() const { return polylidar::tool::free_memory(folder_.path()); }

  TemporaryFolder folder_;
};

TEST_F(FreeMemoryTest, IsUnknownWithoutTheSystemsFiles) {
  EXPECT_FALSE(free());
}

TEST_F(FreeMemoryTest, IsWhatTheSystemSaysWithoutGroups) {
  write("proc/meminfo", "MemTotal: 100 kB\nMemAvailable: 40 kB\n");
  EXPECT_EQ(free(), 40U << 10U);
}

TEST_F(FreeMemoryTest, IsWhatTheTightestGroupAllows) {
  write("proc/meminfo", "MemTotal: 1000 kB\nMemAvailable: 900 kB\n");
  write("proc/self/cgroup", "0::/job/step\n");
  group("job/step", "max", 5000, 0);
  EXPECT_EQ(free(), 900U << 10U) << "no group has a limit";
  group("job", "100000", 40000, 10000);
  EXPECT_EQ(free(), 70000U) << "of the group above; what is cached counts as free";
  group("job/step", "20000", 5000, 0);
  EXPECT_EQ(free(), 15000U);
  group("job/step", "20000", 30000, 0);
  EXPECT_EQ(free(), 0U) << "it uses more than it may";
}

TEST_F(FreeMemoryTest, KnowsTheFirstVersionOfGroups) {
  write("proc/meminfo", "MemAvailable: 900 kB\n");
  write("proc/self/cgroup", "5:cpu:/other\n4:memory:/job\n");
  const std::string at = "sys/fs/cgroup/memory/job/memory.";
  write(at + "limit_in_bytes", "50000\n");
  write(at + "usage_in_bytes", "30000\n");
  write(at + "stat", "inactive_file 9\ntotal_inactive_file 1000\n");
  EXPECT_EQ(free(), 21000U);
}

}  // namespace
}  // namespace hullbench::testing
