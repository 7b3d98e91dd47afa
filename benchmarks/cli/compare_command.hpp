// `hullbench compare A B`: from two paths to what differs between them.
#pragma once

#include <string>

namespace hullbench::cli {

/// The command line of `compare`. A side is the folder of a run or of a suite, a report.json, or the lines of
/// a run (runs.jsonl, runs.jsonl.xz).
struct CompareCommand {
  std::string a;
  std::string b;
  std::string format = "markdown";  ///< "markdown", "csv" (the pairs), "latex" or "json"
};

/// Prints the comparison to standard output. 0, or 6 when the sides share no run, which is said on standard
/// error. Throws ConfigurationError when a path does not exist, std::runtime_error naming it when it is
/// damaged.
int compare_command(const CompareCommand& command);

}  // namespace hullbench::cli
