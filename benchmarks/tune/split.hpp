// Which shapes parameters are fitted on, and which they are judged on.
#pragma once

#include <cstdint>
#include <string>

namespace hullbench::tune {

enum class Side { kTraining, kTest };

/// "training" or "test".
std::string to_string(Side side);

/// The side of a base shape (base_shape in datasets.hpp): a coin thrown by a hash of `seed` and the name, and
/// nothing else. So it does not depend on what other shapes there are, and about half of many are on each
/// side.
Side side_of(const std::string& shape, std::uint64_t seed);

}  // namespace hullbench::tune
