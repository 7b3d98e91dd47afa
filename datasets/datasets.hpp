// The catalogue of data sets: by name, a shape and point samples of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "datasets/shapes.hpp"
#include "polylidar/geometry.hpp"

namespace hullbench {

/// A data set as `hullbench list` shows it.
struct DatasetInfo {
  std::string name;    ///< as in plans and records: "ca"
  std::string title;   ///< as printed in tables: "California"
  std::string source;  ///< who made the data
  std::string licence;
  std::string sha256;  ///< of the shape's file, lower-case hex
  double area = 0;     ///< of the shape without holes, squared units of the points
  bool has_holes_variant = false;
};

/// Points and what they came from.
struct PointSet {
  std::vector<polylidar::Point> points;
  polylidar::MultiPolygon ground_truth;  ///< with its holes cut out when the variant with holes was asked for
  double ground_truth_area = 0;          ///< squared units of the points
  std::string sha256;  ///< of point_bytes(points), lower-case hex: the record's dataset_sha256
};

/// Every data set of `data_directory`, in the order of its manifest. Throws as read_manifest.
std::vector<DatasetInfo> datasets(const std::filesystem::path& data_directory = default_data_directory());

/// The ground truth of data set `name`; `holes`: of its variant with holes, which is one fixed shape (its
/// seed is in the manifest). Throws std::invalid_argument, listing the known names, when there is no such
/// data set or it has no such variant; otherwise as load_shape and with_circular_holes.
polylidar::MultiPolygon make_ground_truth(
    const std::string& name, bool holes,
    const std::filesystem::path& data_directory = default_data_directory());

/// `n` points uniform in that ground truth, with everything a run needs to know about them. Every combination
/// of name, holes, n and seed has a stream of random numbers of its own, so samples of different sizes are
/// independent. Throws as make_ground_truth and sample_uniform.
PointSet make_point_set(const std::string& name, bool holes, std::size_t n, std::uint64_t seed,
                        const std::filesystem::path& data_directory = default_data_directory());

}  // namespace hullbench
