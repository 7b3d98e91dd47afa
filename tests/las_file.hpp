// LAS files of every version and point format, written by the tables of the ASPRS specifications and by
// nothing of the reader's.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "polylidar/geometry.hpp"
#include "tests/point_file_texts.hpp"

namespace hullbench::testing {

struct LasPoint {
  std::int32_t x = 0;
  std::int32_t y = 0;
  unsigned number = 1;
  unsigned returns = 1;
  unsigned classification = 0;
  unsigned source = 0;
  bool withheld = false;
};

struct LasRecord {
  std::string user = "LASF_Projection";
  std::uint16_t id = 0;
  std::string bytes;
};

struct LasFile {
  unsigned minor = 2;
  unsigned format = 0;
  unsigned extra_bytes = 0;  ///< behind each point
  polylidar::Point scale = {0.01, 0.01};
  polylidar::Point offset = {0, 0};
  std::vector<LasPoint> points = {};
  bool has_legacy_count = true;                ///< in 1.4
  std::optional<std::uint64_t> promised = {};  ///< instead of the number of points
  polylidar::Box box = {};                     ///< that the header says
  std::vector<LasRecord> records = {};
  std::vector<LasRecord> extended_records = {};  ///< in 1.4

  polylidar::Point place(const LasPoint& point) const {
    return {point.x * scale.x + offset.x, point.y * scale.y + offset.y};
  }
  Points places() const {
    Points places_of_points;
    for (const LasPoint& point : points) places_of_points.push_back(place(point));
    return places_of_points;
  }

  static std::size_t point_size(unsigned format) {
    return std::array<std::size_t, 11>{20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67}[format];
  }

  std::string text() const {
    const std::size_t header_size = minor >= 4 ? 375 : minor == 3 ? 235 : 227;
    std::string variable;
    for (const LasRecord& record : records) {
      variable += start_of(record) + bytes_of(static_cast<std::uint16_t>(record.bytes.size())) +
                  std::string(32, '\0') + record.bytes;
    }
    // 1.0 has a signature in front of the points.
    if (minor == 0) variable += "\xDD\xCC";
    const std::uint64_t count = promised.value_or(points.size());
    const std::size_t size = point_size(format) + extra_bytes;
    const std::size_t points_at = header_size + variable.size();
    std::string header = "LASF" + std::string(20, '\0') + '\1' + static_cast<char>(minor) +
                         std::string(64, '\0') + std::string(4, '\0');
    header += bytes_of(static_cast<std::uint16_t>(header_size)) +
              bytes_of(static_cast<std::uint32_t>(points_at)) +
              bytes_of(static_cast<std::uint32_t>(records.size())) + static_cast<char>(format) +
              bytes_of(static_cast<std::uint16_t>(size)) +
              bytes_of(minor >= 4 && !has_legacy_count ? 0U : static_cast<std::uint32_t>(count)) +
              std::string(20, '\0');
    for (const double value : {scale.x, scale.y, 0.01, offset.x, offset.y, 0.0}) header += bytes_of(value);
    for (const double value : {box.max.x, box.min.x, box.max.y, box.min.y, 0.0, 0.0})
      header += bytes_of(value);
    if (minor >= 3) header += std::string(8, '\0');
    if (minor >= 4) {
      const std::uint64_t behind = points_at + size * points.size();
      header += bytes_of(extended_records.empty() ? std::uint64_t{0} : behind) +
                bytes_of(static_cast<std::uint32_t>(extended_records.size())) + bytes_of(count) +
                std::string(120, '\0');
    }
    std::string text = header + variable;
    for (const LasPoint& point : points) {
      std::string record =
          bytes_of(point.x) + bytes_of(point.y) + bytes_of(std::int32_t{77}) + bytes_of(std::uint16_t{500});
      if (format >= 6) {
        record += static_cast<char>(point.number | point.returns << 4U);
        record += static_cast<char>(point.withheld ? 4 : 0);
        record += static_cast<char>(point.classification);
        record += std::string(3, '\x55');
      } else {
        record += static_cast<char>(point.number | point.returns << 3U | 0xC0U);
        record += static_cast<char>(point.classification | (point.withheld ? 128U : 32U));
        record += std::string(2, '\x55');
      }
      record += bytes_of(static_cast<std::uint16_t>(point.source));
      record.resize(size, '\x33');
      text += record;
    }
    for (const LasRecord& record : extended_records) {
      text += start_of(record) + bytes_of(std::uint64_t{record.bytes.size()}) + std::string(32, '\0') +
              record.bytes;
    }
    return text;
  }

 private:
  static std::string start_of(const LasRecord& record) {
    std::string user = record.user;
    user.resize(16, '\0');
    return std::string(2, '\0') + user + bytes_of(record.id);
  }
};

inline std::string geokeys(const std::vector<std::uint16_t>& keys) {
  std::string bytes;
  for (const std::uint16_t key : keys) bytes += bytes_of(key);
  return bytes;
}

/// A record with GeoKeys: projected in the system of this number.
inline LasRecord projected(std::uint16_t epsg) {
  return {"LASF_Projection", 34735, geokeys({1, 1, 0, 2, 1024, 0, 1, 1, 3072, 0, 1, epsg})};
}

/// A record with GeoKeys: longitude and latitude.
inline LasRecord geographic(std::uint16_t epsg) {
  return {"LASF_Projection", 34735, geokeys({1, 1, 0, 2, 1024, 0, 1, 2, 2048, 0, 1, epsg})};
}

}  // namespace hullbench::testing
