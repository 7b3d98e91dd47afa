// Who is the fastest on a case, and who is faster than the reference method: judged from the repetitions, as
// everything that is called faster here (statistics/judge.hpp).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/record/record.hpp"

namespace hullbench::report {

/// What the time of a run is beside the others' on the same points.
struct Contest {
  /// Beside the reference method's run: "faster", "slower" or "undecided" (statistics::side_of_times). None
  /// for that run itself, and where it has no result.
  std::optional<std::string> order;
  /// Faster than every run of another method, of which there is one at least. Protocols of one method do not
  /// compete: several of them can be the fastest.
  bool is_fastest = false;
};

/// By the run's id, for every run with a result and times. The reference is the method and protocol of
/// reference_line(), or where it was not run, that method's first protocol.
std::map<std::string, Contest> judge_contests(const std::vector<record::RunRecord>& runs);

}  // namespace hullbench::report
