// This program, as records name it.
#pragma once

#include "benchmarks/base/names.hpp"

namespace hullbench::cli {

/// {name, version, commit, dirty, binary_sha256}; commit and dirty are null when built outside a checkout.
json describe_tool();

}  // namespace hullbench::cli
