#include "datasets/datasets.hpp"

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "datasets/families.hpp"
#include "datasets/holes.hpp"
#include "datasets/point_bytes.hpp"
#include "datasets/random.hpp"
#include "datasets/rgbd/floor_scenes.hpp"
#include "datasets/rgbd/recordings.hpp"
#include "datasets/sampling.hpp"
#include "datasets/sha256.hpp"

namespace hullbench {

namespace {

DatasetInfo describe_shape(const ShapeInfo& shape) {
  return {.name = shape.name,
          .title = shape.title,
          .source = shape.source,
          .licence = shape.licence,
          .sha256 = shape.sha256,
          .area = shape.area,
          .has_holes_variant = shape.holes.has_value()};
}

DatasetInfo describe_family(const ShapeFamily& family) {
  return {.name = family.name,
          .title = family.title,
          .source = family.source,
          .licence = family.licence,
          .sha256 = {},
          .area = std::nullopt,
          .has_holes_variant = family.holes.has_value(),
          .members = family.count};
}

DatasetInfo describe_simulated_floors() {
  return {.name = kSimulatedFloor,
          .title = "Simulated floor",
          .source = "simulated depth images of an Intel RealSense D435i over floors with obstacles",
          .licence = "MIT",
          .sha256 = {},
          .area = std::nullopt,
          .members = kFloorScenes,
          .own_points = true};
}

DatasetInfo describe_recorded_floors(std::size_t count) {
  return {.name = kRecordedFloor,
          .title = "Recorded floor",
          .source = "recordings in a folder of the user's",
          .licence = "the recordings' own",
          .sha256 = {},
          .area = std::nullopt,
          .members = count,
          .own_points = true};
}

std::string names_of(const std::vector<DatasetInfo>& infos, bool only_with_holes) {
  std::string names;
  for (const DatasetInfo& info : infos) {
    if (only_with_holes && !info.has_holes_variant) continue;
    names += (names.empty() ? "" : ", ") + info.name;
    if (info.members > 0) names += "-1 to -" + std::to_string(info.members);
  }
  return names.empty() ? "none" : names;
}

std::vector<DatasetInfo> families(const DataFolders& folders) {
  std::vector<DatasetInfo> infos;
  for (const ShapeFamily& family : shape_families()) infos.push_back(describe_family(family));
  infos.push_back(describe_simulated_floors());
  if (!folders.recordings.empty()) {
    infos.push_back(describe_recorded_floors(list_recordings(folders.recordings).size()));
  }
  return infos;
}

/// The data set that `name` belongs to, and that it has the variant.
DatasetInfo require_dataset(const std::string& name, bool holes, const DataFolders& folders) {
  // Families first: they need no file, and there are thousands of members to ask for.
  std::vector<DatasetInfo> infos = families(folders);
  const DatasetInfo* found = find_dataset(infos, name);
  if (found == nullptr) {
    infos = datasets(folders);
    found = find_dataset(infos, name);
  }
  if (found == nullptr) {
    throw std::invalid_argument("there is no data set '" + name +
                                "'; choose one of: " + names_of(infos, false));
  }
  if (holes && !found->has_holes_variant) {
    throw std::invalid_argument("the data set '" + name + "' has no variant with holes; choose one of: " +
                                names_of(datasets(folders), true));
  }
  return *found;
}

polylidar::MultiPolygon make_file_shape(const std::string& name, bool holes,
                                        const std::filesystem::path& folder) {
  const std::vector<ShapeInfo> shapes = read_manifest(folder);
  const ShapeInfo& info =
      *std::find_if(shapes.begin(), shapes.end(), [&](const ShapeInfo& shape) { return shape.name == name; });
  polylidar::MultiPolygon shape = load_shape(folder, info);
  if (!holes) return shape;
  return with_circular_holes(shape, info.holes->count, info.holes->radius,
                             derive_seed(info.holes->seed, "holes/" + name));
}

polylidar::MultiPolygon make_member_shape(const std::string& family_name, std::size_t index, bool holes) {
  const auto& families = shape_families();
  const auto family = std::find_if(families.begin(), families.end(), [&](const ShapeFamily& candidate) {
    return candidate.name == family_name;
  });
  return family_shape(*family, index, holes);
}

FloorScene make_floor(const std::string& name, std::uint64_t seed, const DataFolders& folders) {
  const auto [family, number] = *split_member_name(name);
  if (family == kSimulatedFloor) return simulate_floor(number - 1, derive_seed(seed, "points/" + name));
  return load_recording(folders.recordings / list_recordings(folders.recordings).at(number - 1));
}

polylidar::MultiPolygon make_shape(const DatasetInfo& info, const std::string& name, bool holes,
                                   const DataFolders& folders) {
  if (info.own_points) return make_floor(name, 0, folders).ground_truth;
  if (info.members == 0) return make_file_shape(name, holes, folders.shapes);
  return make_member_shape(info.name, split_member_name(name)->second - 1, holes);
}

}  // namespace

std::optional<std::pair<std::string, std::size_t>> split_member_name(const std::string& name) {
  const std::size_t dash = name.rfind('-');
  if (dash == std::string::npos || dash + 1 == name.size() || name[dash + 1] == '0') return std::nullopt;
  std::size_t number = 0;
  const char* end = name.data() + name.size();
  const auto [stopped, error] = std::from_chars(name.data() + dash + 1, end, number);
  if (error != std::errc() || stopped != end) return std::nullopt;
  return std::pair{name.substr(0, dash), number};
}

std::vector<DatasetInfo> datasets(const DataFolders& folders) {
  std::vector<DatasetInfo> infos;
  for (const ShapeInfo& shape : read_manifest(folders.shapes)) infos.push_back(describe_shape(shape));
  for (DatasetInfo& family : families(folders)) infos.push_back(std::move(family));
  return infos;
}

const DatasetInfo* find_dataset(const std::vector<DatasetInfo>& infos, const std::string& name) {
  const auto member = split_member_name(name);
  const auto found = std::find_if(infos.begin(), infos.end(), [&](const DatasetInfo& info) {
    if (info.members == 0) return info.name == name;
    return member && info.name == member->first && member->second <= info.members;
  });
  return found == infos.end() ? nullptr : &*found;
}

polylidar::MultiPolygon make_ground_truth(const std::string& name, bool holes, const DataFolders& folders) {
  return make_shape(require_dataset(name, holes, folders), name, holes, folders);
}

PointSet make_point_set(const std::string& name, bool holes, std::size_t n, std::uint64_t seed,
                        const DataFolders& folders) {
  const DatasetInfo info = require_dataset(name, holes, folders);
  if (info.own_points != (n == 0)) {
    throw std::invalid_argument("the data set '" + name +
                                (info.own_points ? "' comes with its points; ask for no number of them"
                                                 : "' has no points of its own; ask for a number of them"));
  }
  PointSet set;
  if (info.own_points) {
    FloorScene scene = make_floor(name, seed, folders);
    set.points = std::move(scene.points);
    set.ground_truth = std::move(scene.ground_truth);
  } else {
    set.ground_truth = make_shape(info, name, holes, folders);
    const std::string label = "points/" + name + "/holes:" + (holes ? "1" : "0") + "/n:" + std::to_string(n);
    set.points = sample_uniform(set.ground_truth, n, derive_seed(seed, label));
  }
  set.ground_truth_area = polylidar::area(set.ground_truth);
  set.sha256 = sha256_hex(point_bytes(set.points));
  return set;
}

}  // namespace hullbench
