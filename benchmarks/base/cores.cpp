#include "benchmarks/base/cores.hpp"

#include <sched.h>

#include <cstddef>

namespace hullbench {

std::vector<int> allowed_cores() {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  std::vector<int> result;
  if (::sched_getaffinity(0, sizeof cores, &cores) != 0) return result;
  for (int core = 0; core < CPU_SETSIZE; ++core) {
    if (CPU_ISSET(static_cast<std::size_t>(core), &cores)) result.push_back(core);
  }
  return result;
}

void leave_core(int core) {
  cpu_set_t others;
  CPU_ZERO(&others);
  for (const int other : allowed_cores()) {
    if (other != core) CPU_SET(static_cast<std::size_t>(other), &others);
  }
  if (CPU_COUNT(&others) > 0) ::sched_setaffinity(0, sizeof others, &others);
}

Cores reserve_worker_core() {
  Cores cores = {allowed_cores(), std::nullopt};
  if (cores.all.empty()) return cores;
  cores.worker = cores.all.back();
  leave_core(*cores.worker);
  return cores;
}

}  // namespace hullbench
