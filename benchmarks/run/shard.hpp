// A part of a plan that is measured by itself, on a machine of its own; merge.hpp puts the parts together.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "benchmarks/plan/plan.hpp"

namespace hullbench::run {

/// One of `count` parts.
struct Shard {
  std::size_t number = 1;  ///< from 1 to `count`
  std::size_t count = 1;
};

/// The shard that "2/3" names. Throws ConfigurationError for anything but two numbers with
/// 1 <= first <= second <= 10000.
Shard parse_shard(const std::string& text);

/// "2/3"
std::string to_string(const Shard& shard);

/// Those of `runs`, which stand case by case, that belong to `shard` of `plan`, in their order: whole cases,
/// so that the methods of a case are timed on the same machine. Every run is in one of the shards, whatever
/// machine asks. Shards have about the same work: case by case, the largest first, each goes to the shard
/// that has the least so far. Empty when there are fewer cases than shards and this is one of the last.
std::vector<plan::PlannedRun> runs_of_shard(const plan::Plan& plan, const std::vector<plan::PlannedRun>& runs,
                                            const Shard& shard);

}  // namespace hullbench::run
