// Points to files that point clouds come in.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "polylidar/geometry.hpp"

namespace polylidar::tool {

/// What points are written as. Each holds a label a point where the points have labels.
enum class PointOutput {
  kCsv,  ///< a header "x,y" or "x,y,label", then a point a line, with the fewest digits that keep every bit
  kXyz,  ///< the same between blanks, without a header
  kNpy,  ///< NumPy's .npy, version 1: little-endian doubles, n x 2, or n x 3 with the label in the third
         ///< column
  kLas,  ///< ASPRS LAS 1.2, point format 0, z = 0, the label as point source id; see LasGrid
};

/// The format that "csv", "xyz", "npy" or "las" names; nothing for another name.
std::optional<PointOutput> point_output_of(const std::string& name);

/// The format that the file's name ends with: .csv, .xyz, .txt (xyz), .npy or .las, in small or large
/// letters.
std::optional<PointOutput> point_output_of_ending(const std::string& path);

/// Throws std::invalid_argument when a file of this format cannot hold so many points.
void check_point_count(PointOutput format, std::uint64_t count);

/// What a file says of its points before the first one.
struct PointFileFacts {
  std::uint64_t count = 0;
  bool has_labels = false;
  Box bounds;  ///< of all points; kLas only
};

/// The whole numbers that LAS has for coordinates: x = offset + scale * X, X of 32 bits. The offset is the
/// middle of the bounds, the scale the least power of ten that reaches them, one for x and y. A coordinate so
/// moves by up to half the scale: less than an 800,000,000th of the larger side.
class LasGrid {
 public:
  explicit LasGrid(const Box& bounds);

  double scale() const { return scale_; }
  const Point& offset() const { return offset_; }
  std::int32_t column(double x) const { return nearest(x - offset_.x); }
  std::int32_t row(double y) const { return nearest(y - offset_.y); }
  /// What a reader makes of it.
  Point place(std::int32_t column, std::int32_t row) const {
    return {column * scale_ + offset_.x, row * scale_ + offset_.y};
  }

 private:
  std::int32_t nearest(double distance) const;

  Point offset_;
  double scale_ = 1;
};

/// Writes one file: the header, then every point.
class PointEncoder {
 public:
  /// Throws as check_point_count.
  PointEncoder(PointOutput format, const PointFileFacts& facts);

  std::string header() const;
  /// Appends the point to `to`. `label` is left out where the file has none. Throws std::invalid_argument for
  /// a label above 65535 in LAS.
  void append(const Point& point, std::uint32_t label, std::string& to) const;

 private:
  PointOutput format_;
  PointFileFacts facts_;
  LasGrid grid_;
};

}  // namespace polylidar::tool
