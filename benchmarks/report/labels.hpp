// What tables call the methods, data sets and failures of a report.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"

namespace hullbench::report {

/// "Polylidar" for "polylidar"; the name itself when `report` has no title for it.
std::string method_title(const json& report, const std::string& method);

/// "Polylidar (paper)": protocols never share a line, so each is part of its line's name.
std::string method_label(const json& report, const std::string& method, const std::string& protocol);

/// The same in the first of `reports` that has a title for it; some may have no methods at all.
std::string method_label(const std::vector<json>& reports, const std::string& method,
                         const std::string& protocol);

/// The family that `dataset` is a member of: "comb" for "comb-17".
std::optional<std::string> family_of(const json& report, const std::string& dataset);

/// "Comb" for "comb-17": the title of the data set, or of the family that it is a member of.
std::string family_title(const json& report, const std::string& dataset);

/// "gradient 16, noise 0.5" of "gradient:16~noise:0.5", what stands behind the first '~' of a data set's
/// name.
std::string stress_title(const std::string& stress);

/// "California with holes", "Comb 17", "California, noise 0.5".
std::string shape_title(const json& report, const std::string& dataset, bool holes);

/// "<what> is not installed: why. To install it: how", for a method whose detail is `detail`.
std::string not_installed_text(const json& report, const std::string& what, const std::string& method,
                               const std::string& detail);

}  // namespace hullbench::report
