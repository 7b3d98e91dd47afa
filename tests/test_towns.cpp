// The towns of countries and their outlines (datasets/towns.hpp).
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "datasets/datasets.hpp"
#include "datasets/towns.hpp"
#include "polylidar/point_locator.hpp"
#include "tests/boost_checks.hpp"
#include "tests/complaint.hpp"
#include "tests/temporary_folder.hpp"

namespace hullbench::testing {

using polylidar::PointLocator;

namespace {

TEST(Towns, LieInTheirCountry) {
  ASSERT_EQ(towns::countries().size(), 35U);
  std::set<std::string> names;
  for (const towns::Country& country : towns::countries()) {
    SCOPED_TRACE(country.name);
    EXPECT_TRUE(names.insert(country.name).second);
    const PointSet set = make_point_set(country.name, false, 0, 1);
    EXPECT_GE(set.points.size(), 400U);
    EXPECT_LE(set.points.size(), 5000U);
    ASSERT_EQ(set.ground_truth.size(), 1U);
    EXPECT_EQ(boost_fault_in_detail(set.ground_truth), "");
    const PointLocator outline(set.ground_truth);
    const auto inside = std::ranges::count_if(set.points, [&](const auto& p) { return outline.contains(p); });
    EXPECT_GT(static_cast<double>(inside), 0.93 * static_cast<double>(set.points.size()));
  }
}

TEST(Towns, HaveTheNamesOfTheFile) {
  const DataFolders folders;
  std::ifstream file(folders.shapes / "towns.geojson");
  std::string line;
  std::getline(file, line);
  for (const towns::Country& country : towns::countries()) {
    std::getline(file, line);
    EXPECT_NE(line.find("\"name\":\"" + country.name + "\",\"title\":\"" + country.title + "\""),
              std::string::npos)
        << country.name;
  }
}

TEST(Towns, AreaOfBelgiumInSquareKilometres) {
  constexpr double kArea = 30'689;  // Statbel
  EXPECT_NEAR(make_point_set("towns-be", false, 0, 1).ground_truth_area, kArea, 0.02 * kArea);
}

TEST(Towns, AChangedFileIsRefused) {
  const TemporaryFolder folder;
  const DataFolders folders;
  const std::filesystem::path copy = folder.path() / "towns.geojson";
  std::filesystem::copy(folders.shapes / "manifest.json", folder.path() / "manifest.json");
  std::filesystem::copy(folders.shapes / "towns.geojson", copy);
  std::ofstream(copy, std::ios::app) << "\n";
  expect_complaint([&] { make_point_set("towns-be", false, 0, 1, DataFolders(folder.path())); },
                   "is not the file that this program was made for; restore it");
}

}  // namespace
}  // namespace hullbench::testing
