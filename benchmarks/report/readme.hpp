// The results in the README: a table of a reference run between two marks.
#pragma once

#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"

namespace hullbench::report {

/// What stands between the marks: where the numbers are from, and time and error of the paper's methods on
/// one shape, of the first report that has it. `folder`: how the README calls the run's folder. Throws
/// std::runtime_error when `reports` is empty.
std::string readme_results(const std::vector<json>& reports, const std::string& folder);

/// `readme` with `results` between its marks <!-- results: begin --> and <!-- results: end -->. Throws
/// std::runtime_error when it has not both, each once, in this order.
std::string with_results(const std::string& readme, const std::string& results);

}  // namespace hullbench::report
