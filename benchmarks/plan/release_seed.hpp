// A seed that nobody picked: of random plans that are no repetition of the paper's.
#pragma once

#include <cstdint>

namespace hullbench::plan {

/// What the seed is made of. It carries the release's date, and changes with the next release only.
inline constexpr const char* kReleaseSentence = "hullbench 1.0, released 2026-12-01";

/// The first eight hexadecimal digits of the sentence's SHA-256, as a number:
/// printf '%s' 'hullbench 1.0, released 2026-12-01' | sha256sum | cut -c 1-8
std::uint64_t release_seed();

}  // namespace hullbench::plan
