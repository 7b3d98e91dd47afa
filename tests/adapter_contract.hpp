// What every adapter must do whatever its method is; adapters/adapter.hpp says it. The tests contract.* try a
// method's worker, which shows more (benchmarks/run/contract.cpp), but with one set of parameters, and it may
// refuse points without an area.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

#include "adapters/adapter.hpp"
#include "adapters/wkb.hpp"
#include "tests/hull_input.hpp"

namespace hullbench::testing {

using MakeAdapter = std::function<std::unique_ptr<Adapter>()>;

/// Runs in between, with and without `reset`, leave no trace, and neither does the object.
inline void expect_the_same_bytes_again(const MakeAdapter& make, const Parameters& parameters,
                                        const Parameters& others) {
  const auto adapter = make();
  const std::vector<Point> points = square_points(kPoints, 3, true);
  const auto first = to_wkb(hull_of(*adapter, points, parameters));
  EXPECT_NE(first, to_wkb({})) << "an empty shape shows nothing";
  NoSteps steps;
  adapter->run(others, steps);
  adapter->run(parameters, steps);
  EXPECT_EQ(to_wkb(adapter->extract(steps)), first);
  adapter->reset();
  adapter->run(parameters, steps);
  EXPECT_EQ(to_wkb(adapter->extract(steps)), first);
  EXPECT_EQ(to_wkb(hull_of(*make(), points, parameters)), first);
}

inline void expect_nothing_without_area(const MakeAdapter& make, const Parameters& parameters) {
  const auto adapter = make();
  for (const auto& [name, points] : degenerate_inputs()) {
    EXPECT_EQ(hull_of(*adapter, points, parameters), MultiPolygon()) << name;
  }
}

inline void expect_duplicates_to_be_ignored(const MakeAdapter& make, const Parameters& parameters) {
  const auto adapter = make();
  const std::vector<Point> points = square_points(500, 5, true);
  std::vector<Point> twice = points;
  twice.insert(twice.end(), points.begin(), points.end());
  EXPECT_DOUBLE_EQ(polylidar::area(hull_of(*adapter, twice, parameters)),
                   polylidar::area(hull_of(*adapter, points, parameters)));
}

/// `parameters` with each value in turn replaced by one that is not a number or below its range, or with a
/// parameter that no method has.
inline void expect_bad_arguments_to_be_refused(const MakeAdapter& make, const Parameters& parameters) {
  const auto adapter = make();
  adapter->load(square_points(100, 6, false));
  NoSteps steps;
  const auto refused = [&](const std::string& name, double value) {
    Parameters bad = parameters;
    bad[name] = value;
    EXPECT_THROW(adapter->run(bad, steps), std::invalid_argument) << name << " = " << value;
  };
  for (const ParameterInfo& parameter : adapter->info().parameters) {
    refused(parameter.name, std::nan(""));
    refused(parameter.name, parameter.minimum - 1);
    if (std::isfinite(parameter.maximum)) refused(parameter.name, parameter.maximum + 1);
    if (parameter.unit == "switch") refused(parameter.name, 0.5);
    if (!parameter.default_value) {
      Parameters without = parameters;
      without.erase(parameter.name);
      EXPECT_THROW(adapter->run(without, steps), std::invalid_argument) << parameter.name;
    }
  }
  refused("unheard_of", 1);
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(adapter->load(std::vector<Point>{{0, 0}, {bad, 1}}), std::invalid_argument) << bad;
  }
}

/// All of the above. `parameters` give a shape with an area for `square_points`; `others` are legal and give
/// another shape.
inline void expect_adapter_contract(const MakeAdapter& make, const Parameters& parameters,
                                    const Parameters& others) {
  expect_the_same_bytes_again(make, parameters, others);
  for (const Parameters& each : {parameters, others}) expect_nothing_without_area(make, each);
  expect_duplicates_to_be_ignored(make, parameters);
  expect_bad_arguments_to_be_refused(make, parameters);
}

/// The hull of a square with a hole, which the parameters `filled` fill and `open` keep.
inline void expect_hole_to_be_filled_or_kept(Adapter& adapter, const Parameters& filled,
                                             const Parameters& open) {
  const std::vector<Point> points = square_points(kPoints, 7, true);
  for (const std::size_t holes : {0U, 1U}) {
    const MultiPolygon hull = hull_of(adapter, points, holes == 0 ? filled : open);
    EXPECT_EQ(hole_count(hull), holes);
    EXPECT_NEAR(polylidar::area(hull), 1 - static_cast<double>(holes) * kHoleArea, kAreaTolerance);
    EXPECT_TRUE(hull.size() == 1 || adapter.info().capabilities.several_polygons);
  }
}

}  // namespace hullbench::testing
