// The processor cores of this process.
#pragma once

#include <optional>
#include <vector>

namespace hullbench {

/// The cores this process may run on, ascending.
std::vector<int> allowed_cores();

/// Keeps this process off `core`, where there is another core for it.
void leave_core(int core);

/// Which cores do what: the last allowed one is the workers', and the harness keeps off it while they work.
struct Cores {
  std::vector<int> all;
  std::optional<int> worker;  ///< none: the system does not tell which cores there are
};

/// Leaves the workers' core.
Cores reserve_worker_core();

}  // namespace hullbench
