#include "benchmarks/record/pictures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "benchmarks/base/configuration_error.hpp"

namespace hullbench::record {
namespace {

/// Of the larger side of a case's box: a step is well below a pixel of any screen.
constexpr double kGridSteps = 65535;
/// So many boxes away from the case a vertex is of no use to anybody who looks.
constexpr double kFarthest = 1e9;

/// Where grid coordinates are counted from, and how long a step is.
struct Grid {
  Point origin;
  double step = 1;
};

Grid grid_of(const PointSet& set) {
  std::vector<Point> all = set.points;
  for (const Polygon& polygon : set.ground_truth)
    all.insert(all.end(), polygon.shell.begin(), polygon.shell.end());
  if (all.empty()) return {};
  const polylidar::Box box = polylidar::bounding_box(all);
  const double side = std::max(box.max.x - box.min.x, box.max.y - box.min.y);
  return {box.min, side > 0 ? side / kGridSteps : 1.0};
}

/// Adds the grid coordinates of `point` to `list`; false when they cannot be told.
bool add_point(json& list, const Point& point, const Grid& grid) {
  const double i = (point.x - grid.origin.x) / grid.step;
  const double j = (point.y - grid.origin.y) / grid.step;
  if (!(std::abs(i) <= kFarthest && std::abs(j) <= kFarthest)) return false;
  list.push_back(std::llround(i));
  list.push_back(std::llround(j));
  return true;
}

bool add_ring(json& polygon, const Ring& ring, const Grid& grid) {
  json list = json::array();
  const bool drawn =
      std::ranges::all_of(ring, [&](const Point& point) { return add_point(list, point, grid); });
  polygon.push_back(std::move(list));
  return drawn;
}

std::optional<json> draw(const MultiPolygon& shape, const Grid& grid) {
  json polygons = json::array();
  for (const Polygon& polygon : shape) {
    json rings = json::array();
    bool drawn = add_ring(rings, polygon.shell, grid);
    for (const Ring& hole : polygon.holes) drawn = drawn && add_ring(rings, hole, grid);
    if (!drawn) return std::nullopt;
    polygons.push_back(std::move(rings));
  }
  return polygons;
}

json draw_case(const std::string& name, const PointSet& set, const Grid& grid) {
  json points = json::array();
  const std::size_t shown = std::min(set.points.size(), PictureBook::kMostPoints);
  for (std::size_t k = 0; k < shown; ++k) add_point(points, set.points[k * set.points.size() / shown], grid);
  return {{"kind", "case"},
          {"case", name},
          {"dataset_sha256", set.sha256},
          {"origin", {grid.origin.x, grid.origin.y}},
          {"step", grid.step},
          {"points_total", set.points.size()},
          {"points", std::move(points)},
          {"ground_truth", draw(set.ground_truth, grid).value_or(json::array())}};
}

json l2_of(const RunRecord& record) {
  return record.metrics.value("l2", json());
}

/// Who competes for a place among the worst: "polylidar/star~noise:0.5/holes:1/protocol:paper".
std::string group_of(const std::string& run_name, const std::string& dataset) {
  const std::string shape = dataset.substr(0, dataset.find('~'));
  const auto member = split_member_name(shape);
  std::string group = run_name;
  const auto number = group.find("/n:");
  const auto holes = group.find("/holes:");
  if (number == std::string::npos || holes == std::string::npos) return group;
  group.erase(number, holes - number);
  if (member) group.replace(group.find('/') + 1, shape.size(), member->first);
  return group;
}

double badness(const json& l2) {
  return l2.is_number() ? l2.get<double>() : std::numeric_limits<double>::infinity();
}

}  // namespace

std::string case_of_run(const std::string& run_name) {
  const auto begin = run_name.find('/') + 1;
  return run_name.substr(begin, run_name.find("/protocol:") - begin);
}

PictureBook::PictureBook(const fs::path& folder, std::size_t planned_runs)
    : keep_all_(planned_runs <= kAllPictures), writer_(folder / kPicturesFile) {
  try {
    for (const json& line : load_json_lines(folder / kPicturesFile).lines) {
      const std::string name = line.at("case").get<std::string>();
      if (line.at("kind") == "case") {
        cases_.insert(name);
      } else {
        const std::string dataset = name.substr(0, name.find("/n:"));
        remember(group_of(line.at("run").get<std::string>(), dataset), badness(line.at("l2")));
      }
    }
  } catch (const json::exception&) {
    throw ConfigurationError("a line of " + (folder / kPicturesFile).string() +
                             " is not a picture; start anew with --force or another --out");
  }
}

bool PictureBook::is_wanted(const std::string& group, double error) const {
  if (keep_all_) return true;
  const auto kept = worst_.find(group);
  return kept == worst_.end() || kept->second.size() < kWorstPictures || error > *kept->second.begin();
}

void PictureBook::remember(const std::string& group, double error) {
  std::multiset<double>& kept = worst_[group];
  kept.insert(error);
  if (kept.size() > kWorstPictures) kept.erase(kept.begin());
}

void PictureBook::add(const RunRecord& record, const PointSet& set, const MultiPolygon& result) {
  const std::string group = group_of(record.name, record.dataset);
  const double error = badness(l2_of(record));
  if (!is_wanted(group, error)) return;
  const Grid grid = grid_of(set);
  std::optional<json> polygons = draw(result, grid);
  if (!polygons) return;
  remember(group, error);
  const std::string name = case_of_run(record.name);
  if (cases_.insert(name).second) writer_.append(draw_case(name, set, grid));
  writer_.append({{"kind", "result"},
                  {"case", name},
                  {"run", record.name},
                  {"id", record.id},
                  {"output_sha256", record.output_sha256},
                  {"l2", l2_of(record)},
                  {"polygons", std::move(*polygons)}});
}

void merge_pictures(const std::vector<fs::path>& folders, const fs::path& out) {
  std::optional<JsonLinesWriter> writer;
  std::set<std::string> known;
  for (const fs::path& folder : folders) {
    const fs::path plain = folder / kPicturesFile;
    const fs::path file = fs::exists(plain) ? plain : fs::path(plain.string() + ".xz");
    for (const json& line : load_json_lines(file).lines) {
      // No method's name has a space, so no run is called as a case is here.
      if (!known.insert(line.value("run", "case " + line.value("case", ""))).second) continue;
      if (!writer) writer.emplace(out / kPicturesFile);
      writer->append(line);
    }
  }
}

}  // namespace hullbench::record
