// The time of day, for records.
#pragma once

#include <string>

namespace hullbench {

/// "2026-01-31T12:00:00Z" now.
std::string utc_now();

}  // namespace hullbench
