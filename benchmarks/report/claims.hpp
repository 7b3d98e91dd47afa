// The paper's claims beside what a run measured.
#pragma once

#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/report/measurements.hpp"

namespace hullbench::report {

/// The paper's published values and claims: results/paper.json, which is part of the program.
const json& paper();

/// What every ratio is quoted beside: this project's method with the paper's parameters.
Line reference_line();

/// The steps of a method that the paper tells apart, in its order, each with what methods call it or its
/// parts in their phases.
struct PaperStep {
  std::string name;
  std::vector<std::string> parts;
};
const std::vector<PaperStep>& paper_steps();

/// Which method tells the steps of `method`, "polylidar_steps" of "polylidar"; `method` itself where none
/// does. Both are one method: neither is the other's rival.
std::string teller_of(const std::string& method);

/// Whether a claim of paper() compares times, be it of a step.
bool is_about_time(const json& claim);

/// Every claim of the paper that concerns state shapes, checked against the `protocol: paper` rows of
/// `report`: a list of {id, claim, where, paper, ours (text), value (number or null), equal_work (text or
/// null), verdict, detail}. The verdict is "confirmed"; of a claim that gives a number "larger" or "smaller"
/// where ours is outside of the band round it; of any other "refuted"; each if the whole interval of the
/// ratio says so (statistics/judge.hpp, ratios.hpp), else "undecided"; null: not measured here. A claim about
/// every case needs each of them; one case against it refutes it. Claims about time are not judged when there
/// are no times (see Measurements).
json check_claims(const json& report);

}  // namespace hullbench::report
