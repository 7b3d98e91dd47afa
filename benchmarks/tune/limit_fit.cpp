#include "benchmarks/tune/limit_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "benchmarks/tune/fit_score.hpp"
#include "polylidar/delaunay.hpp"

namespace hullbench::tune {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// In medians; it moves the cells so that the median itself does not lie where one ends.
constexpr double kUnit = 0.93;
constexpr int kCellsOfAnOctave = 16;
constexpr int kFirstExponent = -1;  ///< cell 0 begins at 2^-1 units

using CellValues = std::array<double, kLimitCells>;

struct TriangleSize {
  double perimeter = 0;
  double area = 0;
};

std::vector<TriangleSize> triangle_sizes(std::span<const polylidar::Point> points) {
  const polylidar::Triangulation mesh = polylidar::delaunay(points);
  std::vector<TriangleSize> sizes;
  sizes.reserve(mesh.triangles.size() / 3);
  for (std::size_t e = 0; e < mesh.triangles.size(); e += 3) {
    const std::array<polylidar::Point, 3> corners = {points[mesh.triangles[e]], points[mesh.triangles[e + 1]],
                                                     points[mesh.triangles[e + 2]]};
    TriangleSize size;
    size.area = std::abs(polylidar::signed_area(corners));
    for (std::size_t k = 0; k < 3; ++k) {
      const polylidar::Point& to = corners[(k + 1) % 3];
      size.perimeter += std::hypot(to.x - corners[k].x, to.y - corners[k].y);
    }
    sizes.push_back(size);
  }
  return sizes;
}

/// The first cell that ends above `length`, in medians; kLimitCells when none does.
std::size_t cell_of(double length) {
  std::size_t c = 0;
  while (c < kLimitCells && cell_limit(c + 1) <= length) ++c;
  return c;
}

/// s of the rule at every cell; NaN or infinity where it is not defined.
CellValues growth_of(const LimitSample& sample, std::size_t below, std::size_t above) {
  CellValues log_area = {};  // of all cells below
  double sum = 0;
  for (std::size_t c = 0; c < kLimitCells; ++c) {
    log_area[c] = std::log(sum);
    sum += sample.area[c];
  }
  CellValues growth;
  growth.fill(kInfinity);
  for (std::size_t c = below; c + above < kLimitCells; ++c) {
    growth[c] =
        (log_area[c + above] - log_area[c - below]) / std::log(cell_limit(c + above) / cell_limit(c - below));
  }
  return growth;
}

/// What a limit's growth is multiplied with; infinite where the limit may not be.
CellValues weights_of(const LimitConstants& constants) {
  CellValues weight = {};
  for (std::size_t c = 0; c < kLimitCells; ++c) {
    const double limit = cell_limit(c);
    const double distance = std::log(limit / constants.usual);
    weight[c] = limit < constants.least || limit > constants.most
                    ? kInfinity
                    : std::exp(constants.pull * distance * distance);
  }
  return weight;
}

std::optional<std::size_t> cheapest_cell(const CellValues& growth, const CellValues& weight, double still) {
  double least_cost = kInfinity;
  std::optional<std::size_t> cheapest;
  for (std::size_t c = 0; c < kLimitCells; ++c) {
    const double cost = (growth[c] + still) * weight[c];
    if (cost < least_cost) {  // no where it is infinite or NaN
      least_cost = cost;
      cheapest = c;
    }
  }
  return cheapest;
}

double error_with(const LimitCase& one, std::optional<std::size_t> cell, double usual) {
  return one.errors[std::min(cell.value_or(cell_of(usual)), kLimitCells - 1)];
}

}  // namespace

double cell_limit(std::size_t c) {
  const std::size_t octave = c / kCellsOfAnOctave;
  const double share = 1 + static_cast<double>(c % kCellsOfAnOctave) / kCellsOfAnOctave;
  return kUnit * std::ldexp(share, static_cast<int>(octave) + kFirstExponent);
}

std::optional<LimitSample> look_at(std::span<const polylidar::Point> points) {
  std::vector<TriangleSize> sizes = triangle_sizes(points);
  if (sizes.empty()) return std::nullopt;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end(),
                   [](const TriangleSize& a, const TriangleSize& b) { return a.perimeter < b.perimeter; });
  LimitSample sample;
  sample.median = middle->perimeter;
  for (const TriangleSize& size : sizes) {
    const std::size_t cell = cell_of(size.perimeter / sample.median);
    if (cell < kLimitCells) sample.area[cell] += size.area;
  }
  return sample;
}

std::optional<std::size_t> chosen_cell(const LimitSample& sample, const LimitConstants& constants) {
  return cheapest_cell(growth_of(sample, constants.below, constants.above), weights_of(constants),
                       constants.still);
}

LimitGrid usual_limit_grid() {
  return {.usual = {1.3, 1.4, 1.5, 1.6, 1.7, 1.8, 2.0},
          .pull = {1, 1.5, 2, 2.5, 3, 4},
          .still = {0.001, 0.002, 0.003, 0.005, 0.01, 0.02},
          .least = {1.0, 1.1, 1.2},
          .most = {4, 5, 6},
          .below = {6, 8, 10, 12, 14},
          .above = {1, 2, 3, 4}};
}

std::array<std::size_t, 2> limit_cells(const LimitGrid& grid) {
  const double least = std::min(*std::min_element(grid.least.begin(), grid.least.end()),
                                *std::min_element(grid.usual.begin(), grid.usual.end()));
  const double most = std::max(*std::max_element(grid.most.begin(), grid.most.end()),
                               *std::max_element(grid.usual.begin(), grid.usual.end()));
  return {cell_of(least), std::min(cell_of(most) + 1, kLimitCells)};
}

LimitScore score_limit(const std::vector<LimitCase>& cases, const LimitConstants& constants) {
  std::vector<std::string> shapes;
  std::vector<double> errors;
  for (const LimitCase& one : cases) {
    shapes.push_back(one.shape);
    errors.push_back(error_with(one, chosen_cell(one.sample, constants), constants.usual));
  }
  return {constants, fit_score(shapes, errors)};
}

std::vector<LimitScore> fit_limit(const std::vector<LimitCase>& cases, const LimitGrid& grid) {
  std::vector<std::string> shapes;
  for (const LimitCase& one : cases) shapes.push_back(one.shape);
  std::vector<LimitScore> scores;
  std::vector<double> errors(cases.size());
  for (const std::size_t below : grid.below) {
    for (const std::size_t above : grid.above) {
      std::vector<CellValues> growths;
      for (const LimitCase& one : cases) growths.push_back(growth_of(one.sample, below, above));
      for (const double usual : grid.usual) {
        for (const double pull : grid.pull) {
          for (const double least : grid.least) {
            for (const double most : grid.most) {
              const LimitConstants about = {usual, pull, 0, least, most, below, above};
              const CellValues weight = weights_of(about);
              for (const double still : grid.still) {
                for (std::size_t i = 0; i < cases.size(); ++i)
                  errors[i] = error_with(cases[i], cheapest_cell(growths[i], weight, still), usual);
                LimitConstants constants = about;
                constants.still = still;
                scores.push_back({constants, fit_score(shapes, errors)});
              }
            }
          }
        }
      }
    }
  }
  std::stable_sort(scores.begin(), scores.end(),
                   [](const LimitScore& a, const LimitScore& b) { return a.score < b.score; });
  return scores;
}

}  // namespace hullbench::tune
