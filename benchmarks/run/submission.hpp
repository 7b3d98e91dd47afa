// A method that is handed in: a folder with the rows and polygons of the plan `submission`, measured by its
// author, and what must be true of it before anybody believes it.
//
//   submission.json   the method, its contract, the hash of every other file (results/submission.schema.json)
//   run/              the run, with its polygons
//   method/           the method's manifest and the files beside it, where it has one
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/plan/plan.hpp"
#include "benchmarks/run/contract.hpp"
#include "benchmarks/run/rescore.hpp"
#include "datasets/datasets.hpp"

namespace hullbench::run {

inline constexpr const char* kSubmissionFile = "submission.json";
inline constexpr const char* kSubmissionPlan = "submission";
inline constexpr const char* kSubmissionRun = "run";
inline constexpr const char* kSubmissionMethod = "method";
/// What the title of a method that was handed in ends with, and its `division` in run.json.
inline constexpr const char* kHandedIn = " (handed in)";
inline constexpr const char* kOpenDivision = "open";

/// The files in `folder` but submission.json, as paths from there, in order.
std::vector<std::string> submitted_files(const fs::path& folder);

/// What no entry of a method that is handed in may ask for in a plan's "methods": cases, limits or
/// repetitions of its own, or another parameter for each case. Empty when it does not.
std::string fault_of_entries(const json& entries);

/// Checks the pack in `folder` against `plan`, the plan `submission` of this program: files, records, plan,
/// rows, and every score, worked out anew from the polygons on the points that this program draws. `known`:
/// the methods of this program, which nobody hands in. Hands each verdict to `say` as it comes. Times, memory
/// and the contract cannot be checked. Stops after a verdict that the others stand on. The folder is a
/// stranger's: whatever is in it gives a verdict. Returns the run with the scores of this program; none when
/// a verdict was bad.
///
/// Throws ConfigurationError when there is no pack in the folder, and Interrupted.
std::optional<Rescored> check_submission(const fs::path& folder, const plan::Plan& plan,
                                         const std::vector<std::string>& known, const std::vector<int>& cores,
                                         const DataFolders& folders,
                                         const std::function<void(const Verdict&)>& say);

}  // namespace hullbench::run
