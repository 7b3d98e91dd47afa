// A method that is a library of its own: it comes into the process when it is asked for, and no sooner.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "adapters/adapter.hpp"
#include "adapters/adapter_module.hpp"
#include "tests/complaint.hpp"

namespace hullbench::testing {
namespace {

bool is_in_this_process(const std::string& library) {
  std::ifstream maps("/proc/self/maps");
  const std::string text(std::istreambuf_iterator<char>(maps), {});
  EXPECT_NE(text.find("libstdc++"), std::string::npos) << "the list must have what is certainly there";
  return text.find(library) != std::string::npos;
}

TEST(AdapterModule, SaysWhyItCannotBeLoaded) {
  const auto refusal = [](const char* file) {
    try {
      load_adapter_module(file, "make build");
      return std::string("loaded");
    } catch (const NotInstalled& error) {
      return std::string(error.what()) + " -> " + error.remedy();
    }
  };
  const std::string missing = refusal("/nowhere/libmethod.so");
  expect_says(missing, "/nowhere/libmethod.so");
  expect_says(missing, " -> make build");
  EXPECT_NE(refusal("libc.so.6").find("hullbench_make_adapter"), std::string::npos) << "no method is in it";
}

void expect_library_comes_with(const std::string& method, const std::string& library) {
  const AdapterEntry* found = find_adapter(method);
  ASSERT_NE(found, nullptr);
  EXPECT_FALSE(is_in_this_process(library));
  try {
    const auto adapter = found->make();
    EXPECT_EQ(adapter->info().name, method);
  } catch (const NotInstalled& error) {
    GTEST_SKIP() << "skipped: " << error.what() << "; " << error.remedy();
  }
  EXPECT_TRUE(is_in_this_process(library));
}

TEST(AdapterModule, BringsPclWhenItIsAskedFor) {
  expect_library_comes_with("pcl_concave_hull", "libpcl_surface");
}

TEST(AdapterModule, BringsSpatialiteWhenItIsAskedFor) {
  expect_library_comes_with("spatialite", "libspatialite");
}

}  // namespace
}  // namespace hullbench::testing
