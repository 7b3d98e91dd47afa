// This program, as records name it.
#pragma once

#include <nlohmann/json.hpp>

namespace hullbench::cli {

/// {name, version, commit, dirty, binary_sha256}; commit and dirty are null when built outside a checkout.
nlohmann::json describe_tool();

}  // namespace hullbench::cli
