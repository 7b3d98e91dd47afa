// Which format the reader of points gets: each has a fuzz target of its own.
#pragma once

namespace polylidar::fuzz {

/// As point_format_of() takes it: "las".
extern const char* const kFuzzedFormat;

}  // namespace polylidar::fuzz
