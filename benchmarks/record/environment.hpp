// The machine and the program that measured: what a reader needs to compare two reports. Nothing in it names
// a person, a host or a path.
#pragma once

#include <string>

#include "benchmarks/base/names.hpp"

namespace hullbench::record {

/// The environment as it is now, with these members (null where the system does not tell):
/// `machine_id`; `cpu` {model, architecture, logical_cores, allowed_cores, governors, boost, virtualised};
/// `memory_bytes`; `load_average` (1, 5 and 15 minutes); `aslr` (kernel.randomize_va_space: 0, 1 or 2);
/// `huge_pages` {kernel, malloc} (huge_pages.hpp);
/// `kernel`; `os`; `temperature_celsius`; `compiler` {id, version, build_type, native, flags,
/// flags_by_target, statement}; `libraries` (version by name, of those found when the program was built, and
/// of the C library that runs).
json collect_environment();

/// The first 8 hexadecimal digits of the SHA-256 of "<CPU model>|<logical cores>|<memory in whole GiB>": the
/// same for machines of the same make, so it tells nothing about whose machine it is. Part of a run
/// directory's name.
std::string machine_id();

/// The same of given values.
std::string machine_id(const std::string& cpu_model, long logical_cores, long memory_gib);

}  // namespace hullbench::record
