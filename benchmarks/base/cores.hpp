// The processor cores of this process.
#pragma once

#include <vector>

namespace hullbench {

/// The cores this process may run on, ascending.
std::vector<int> allowed_cores();

/// Keeps this process off `core`, where there is another core for it.
void leave_core(int core);

}  // namespace hullbench
