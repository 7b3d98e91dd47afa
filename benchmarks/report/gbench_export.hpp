// A run as Google Benchmark would have written it, for the tools that read its JSON (compare.py).
#pragma once

#include <filesystem>
#include <vector>

#include "benchmarks/base/names.hpp"

namespace hullbench::report {

/// The reports (as made by make_report, one or more) in the layout of Google Benchmark 1.7: a `context`, and
/// `benchmarks` with an entry for every repetition of every run that gave a valid result, in nanoseconds of
/// equal work, followed, of two or more, by their mean, median, stddev and cv. A run is called by its name,
/// with its plan before it when there are several reports, and with "/run:2" behind it for the second run of
/// the same name (another seed or parameter set). The CPU's time is not measured: cpu_time repeats real_time,
/// which the context says. What else was not recorded is 0, empty or absent; the machine's id stands for its
/// name.
nlohmann::ordered_json gbench_report(const std::vector<json>& reports);

/// Writes it to `file`. Throws std::runtime_error naming the file when it cannot be written.
void export_gbench(const fs::path& file, const std::vector<json>& reports);

}  // namespace hullbench::report
