#include "datasets/datasets.hpp"

#include <algorithm>
#include <stdexcept>

#include "datasets/holes.hpp"
#include "datasets/point_bytes.hpp"
#include "datasets/random.hpp"
#include "datasets/sampling.hpp"
#include "datasets/sha256.hpp"

namespace hullbench {

namespace {

std::string names_of(const std::vector<ShapeInfo>& shapes, bool only_with_holes) {
  std::string names;
  for (const ShapeInfo& shape : shapes) {
    if (only_with_holes && !shape.holes) continue;
    names += (names.empty() ? "" : ", ") + shape.name;
  }
  return names.empty() ? "none" : names;
}

ShapeInfo find_shape(const std::string& name, bool holes, const std::filesystem::path& data_directory) {
  const std::vector<ShapeInfo> shapes = read_manifest(data_directory);
  const auto found =
      std::find_if(shapes.begin(), shapes.end(), [&](const ShapeInfo& shape) { return shape.name == name; });
  if (found == shapes.end()) {
    throw std::invalid_argument("there is no data set '" + name +
                                "'; choose one of: " + names_of(shapes, false));
  }
  if (holes && !found->holes) {
    throw std::invalid_argument("the data set '" + name +
                                "' has no variant with holes; choose one of: " + names_of(shapes, true));
  }
  return *found;
}

}  // namespace

std::vector<DatasetInfo> datasets(const std::filesystem::path& data_directory) {
  std::vector<DatasetInfo> infos;
  for (const ShapeInfo& shape : read_manifest(data_directory)) {
    infos.push_back({.name = shape.name,
                     .title = shape.title,
                     .source = shape.source,
                     .licence = shape.licence,
                     .sha256 = shape.sha256,
                     .area = shape.area,
                     .has_holes_variant = shape.holes.has_value()});
  }
  return infos;
}

polylidar::MultiPolygon make_ground_truth(const std::string& name, bool holes,
                                          const std::filesystem::path& data_directory) {
  const ShapeInfo info = find_shape(name, holes, data_directory);
  polylidar::MultiPolygon shape = load_shape(data_directory, info);
  if (!holes) return shape;
  return with_circular_holes(shape, info.holes->count, info.holes->radius,
                             derive_seed(info.holes->seed, "holes/" + name));
}

PointSet make_point_set(const std::string& name, bool holes, std::size_t n, std::uint64_t seed,
                        const std::filesystem::path& data_directory) {
  PointSet set;
  set.ground_truth = make_ground_truth(name, holes, data_directory);
  set.ground_truth_area = polylidar::area(set.ground_truth);
  const std::string label = "points/" + name + "/holes:" + (holes ? "1" : "0") + "/n:" + std::to_string(n);
  set.points = sample_uniform(set.ground_truth, n, derive_seed(seed, label));
  set.sha256 = sha256_hex(point_bytes(set.points));
  return set;
}

}  // namespace hullbench
