// Huge pages, the same for all methods. The core asks the kernel for them (core/src/scratch.cpp); so that no
// other method goes without, the malloc of every worker's process asks too, and of the processes it starts.
#pragma once

#include <string>
#include <string_view>

#include "benchmarks/base/names.hpp"

namespace hullbench {

/// The environment variable by which the GNU C library, from 2.35 on, is told to ask for them; older ones
/// pass over what they do not know. Java has a heap and a switch of its own, which its manifest sets; Node's
/// heap has no switch.
inline constexpr std::string_view kTunablesVariable = "GLIBC_TUNABLES";

/// What workers get as GLIBC_TUNABLES where the harness itself has `own` (empty: nothing): the same and
/// glibc.malloc.hugetlb=1, unless `own` says already what that is to be. Settings are separated by colons.
std::string worker_tunables(std::string_view own);

/// `kernel`: which programs get transparent huge pages, "always", "madvise" (those that ask) or "never"; null
/// where the kernel does not tell. `malloc`: what workers' malloc is told, "glibc.malloc.hugetlb=1" unless
/// the user's own GLIBC_TUNABLES says otherwise.
json huge_pages();

}  // namespace hullbench
