// The zoo: inputs that made some public tool fail, each made anew after the description in its public issue.
// No coordinate is the reporter's: a generator makes points with the property that the thread describes.
#pragma once

#include <string>
#include <vector>

#include "polylidar/geometry.hpp"

namespace hullbench::zoo {

/// What a right answer is. In every case a valid one: a crash, a result that is not valid, or none in time is
/// not right.
enum class Answer {
  kEmpty,   ///< the points have no area: an empty result or an error that says so
  kCovers,  ///< the points are of no known shape: at least kCovered of them must be in the result or on its
            ///< edge
  kShape,   ///< the points are of a known shape: the result must be like it
};

/// The share of the points that a right answer covers where no shape is known.
inline constexpr double kCovered = 0.9;

/// The points of a case and the shape they came from; the shape is empty unless Answer::kShape.
struct Input {
  std::vector<polylidar::Point> points;
  polylidar::MultiPolygon ground_truth;
};

/// One animal: an entry of zoo.json with its generator.
struct Case {
  std::string name;      ///< of the data set: "zoo-geos-754", the tool and the number of its issue
  std::string title;     ///< what the points are, as printed in tables
  std::string fault;     ///< what the tool did with such points
  std::string citation;  ///< the issue: "libgeos/geos#754"
  Answer answer = Answer::kCovers;
  Input (*make)() = nullptr;  ///< the same bits on every machine
};

/// Every case, by kind: few points, flat ones, close ones, lattices, clouds.
const std::vector<Case>& cases();

/// The case of that name; null when there is none.
const Case* find_case(const std::string& name);

}  // namespace hullbench::zoo
