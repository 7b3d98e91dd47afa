#include "tests/fuzz/point_format.hpp"

namespace polylidar::fuzz {

const char* const kFuzzedFormat = FUZZED_FORMAT;

}  // namespace polylidar::fuzz
