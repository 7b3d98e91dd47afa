// Tests that read files of points: as a whole, in parts, and as sources.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "tests/temporary_folder.hpp"
#include "tool/points/point_file.hpp"
#include "tool/points/point_sources.hpp"

namespace polylidar::tool {

class PointReadingTest : public ::testing::Test {
 protected:
  /// Writes a file; its path.
  std::string file(const std::string& name, const std::string& bytes) const {
    std::string path = (folder_.path() / name).string();
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }

  /// The points and the classes of all parts of a file, one part after another.
  static PointFile read_in_parts(const std::string& path, std::size_t parts, PointFileOptions options = {}) {
    PointFile all;
    options.take_points = [&](std::span<const Point> block) {
      all.points.insert(all.points.end(), block.begin(), block.end());
    };
    for (std::size_t part = 0; part < parts; ++part) {
      options.part = {part, parts};
      const PointFile of_part = read_point_file(path, options);
      EXPECT_TRUE(of_part.points.empty());
      for (std::size_t c = 0; c < all.classes.size(); ++c) all.classes[c] += of_part.classes[c];
    }
    return all;
  }

  /// The points that the sources give, one source after another.
  static std::vector<Point> points_of(const std::vector<PointSource>& sources) {
    std::vector<Point> points;
    for (const PointSource& source : sources) {
      source([&](std::span<const Point> block) { points.insert(points.end(), block.begin(), block.end()); });
    }
    return points;
  }

 private:
  hullbench::testing::TemporaryFolder folder_;
};

}  // namespace polylidar::tool
