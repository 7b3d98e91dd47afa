// Which data sets parameters and rules are fitted on, and which they are judged on: whole sources of shapes
// and whole ways to sample, fixed in split.cpp with the reason of each.
#pragma once

#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"

namespace hullbench::tune {

/// kNeither: nobody fits there and nobody is judged there.
enum class Side { kTraining, kTest, kNeither };

/// "training", "test" or "neither".
std::string to_string(Side side);

/// Where a source of shapes or a way to sample stands.
struct SplitRow {
  std::string name;
  Side side = Side::kNeither;
  std::string reason;  ///< one sentence
};

/// Every source of shapes: a family's name, "state", "letter", "degenerate" or "zoo".
const std::vector<SplitRow>& shape_split();

/// Every way to sample: "uniform", and the kinds of stress.hpp. None is kNeither: who is not training is for
/// tests only.
const std::vector<SplitRow>& sampler_split();

/// The source in shape_split() of a data set, whatever its stress: "state" of "ca~noise:0.5", "star" of
/// "star-17". The base shape itself where the split does not know it.
std::string source_of(const std::string& dataset);

/// The ways in which a data set's points are drawn: {"gradient", "noise"} of "ca~gradient:4~noise:0.5",
/// {"uniform"} of a name without stress, {"depthcamera"} of floors, which come with their points.
std::vector<std::string> samplers_of(const std::string& dataset);

/// Whether one of the data set's ways to sample is for tests only: no parameter was fitted on points like
/// these.
bool has_unseen_sampler(const std::string& dataset);

/// Test where the shape's source is, however it is sampled; training where the source is and no sampler is
/// for tests only; else neither: a training shape as only tests sample it, points that come without a shape,
/// and sources that the split does not know.
Side side_of(const std::string& dataset);

/// The split as records have it: {"shapes": {"star": "training", ...}, "samplers": {"uniform": "training",
/// ...}}.
json split_to_json();

}  // namespace hullbench::tune
