#include "datasets/stress.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include "datasets/point_stream.hpp"
#include "datasets/samplers/airborne.hpp"
#include "datasets/samplers/boundary.hpp"
#include "datasets/samplers/density.hpp"
#include "datasets/samplers/depth_camera.hpp"
#include "datasets/samplers/regular.hpp"
#include "datasets/samplers/rotating.hpp"
#include "datasets/samplers/tracks.hpp"
#include "datasets/samplers/transcripts.hpp"

namespace hullbench {

using polylidar::MultiPolygon;
using polylidar::Point;

namespace {

/// A plain decimal, the shortest that gives this number; none for other texts.
std::optional<double> canonical_number(const std::string& text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value, std::chars_format::fixed);
  if (error != std::errc() || stopped != end || !std::isfinite(value)) return std::nullopt;
  char again[64];
  const auto written = std::to_chars(std::begin(again), std::end(again), value, std::chars_format::fixed);
  if (written.ec != std::errc() || std::string(std::begin(again), written.ptr) != text) return std::nullopt;
  return value;
}

/// "noise:0.5".
std::optional<Stress> parse_stress(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) return std::nullopt;
  const auto& kinds = stress_kinds();
  const auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const StressKind& candidate) {
    return candidate.name == text.substr(0, colon);
  });
  const std::optional<double> level = canonical_number(text.substr(colon + 1));
  if (kind == kinds.end() || !level || *level < kind->least || *level > kind->most) return std::nullopt;
  return Stress{&*kind, *level};
}

}  // namespace

const std::vector<StressKind>& stress_kinds() {
  using enum StressRole;
  static const std::vector<StressKind> kinds = {
      {"noise", "noise", "h", "Gaussian noise of this standard deviation", 0, 10, kNoise},
      {"outliers", "outliers", "%", "so many of the points uniform in a larger box", 0, 90, kOutliers},
      {"quantised", "quantised", "h", "coordinates rounded to multiples of this", 0, 10, kRounds},
      {"water", "water", "%", "lakes without points, so much of the shape's area", 0, 50, kDries},
      {"gradient", "gradient", "", "density at the left side over density at the right", 1, 1000, kDraws,
       &sample_gradient},
      {"hotspot", "hot spot", "", "density at a Gaussian peak over density round it", 1, 1000, kDraws,
       &sample_hotspot},
      {"clusters", "clusters", "", "points in a Gaussian cluster on average", 1, 1000, kDraws,
       &sample_clusters},
      {"cascade", "cascade", "", "density in one half of each part over that in the other, ten times halved",
       1, 4, kDraws, &sample_cascade},
      {"poisson", "Poisson disks", "h", "least distance of two points", 0.25, 0.75, kDraws, &sample_poisson},
      {"lattice", "lattice", "", "largest move of a lattice's points, in its sides", 0, 0.5, kDraws,
       &sample_lattice},
      {"boundary", "boundary", "%", "so many of the points on the rings", 0, 100, kDraws, &sample_boundary},
      {"outline", "outline", "", "deviation of points from the rings, in their mean distance along them", 0,
       10, kDraws, &sample_outline},
      {"depthcamera", "depth camera", "", "distance of the shape's middle over the camera's height", 1, 20,
       kDraws, &sample_depth_camera},
      {"airborne", "airborne scanner", "", "distance of parallel scan lines over that of a line's points", 1,
       20, kDraws, &sample_airborne},
      {"zigzag", "zigzag scanner", "", "mean distance of zigzag scan lines over that of a line's points", 1,
       20, kDraws, &sample_zigzag},
      {"rotating", "rotating lidar", "", "distance of rings at half the range over that of a ring's points",
       1, 20, kDraws, &sample_rotating},
      {"tracks", "tracks", "", "distance of roads over that of a road's points", 1, 50, kDraws,
       &sample_tracks},
      {"transcripts", "transcripts", "%", "so many of a cell's molecules are its neighbours'", 0, 50, kDraws,
       &sample_transcripts},
  };
  return kinds;
}

std::optional<std::pair<std::string, std::vector<Stress>>> split_stress(const std::string& name) {
  std::size_t mark = name.find('~');
  std::pair<std::string, std::vector<Stress>> parts = {name.substr(0, mark), {}};
  while (mark != std::string::npos) {
    const std::size_t start = mark + 1;
    mark = name.find('~', start);
    const std::optional<Stress> stress = parse_stress(name.substr(start, mark - start));
    if (!stress) return std::nullopt;
    if (!parts.second.empty() && parts.second.back().kind->role >= stress->kind->role) return std::nullopt;
    parts.second.push_back(*stress);
  }
  return parts;
}

std::vector<Point> sample_stressed(const MultiPolygon& shape, std::size_t n,
                                   const std::vector<Stress>& stresses, std::uint64_t seed) {
  PointStream stream(shape, n, stresses, seed);
  std::vector<Point> points(n);
  for (Point& point : points) point = stream.next();
  return points;
}

}  // namespace hullbench
