#include "kernels.hpp"

namespace polylidar::detail {

bool is_supported(Kernel kernel) {
#ifdef POLYLIDAR_X86_KERNELS
  if (kernel == Kernel::kAvx512) return __builtin_cpu_supports("avx512f") != 0;
  if (kernel == Kernel::kAvx2) return __builtin_cpu_supports("avx2") != 0;
#endif
  return kernel == Kernel::kPortable;
}

Kernel best_kernel() {
  static const Kernel best = is_supported(Kernel::kAvx512) ? Kernel::kAvx512
                             : is_supported(Kernel::kAvx2) ? Kernel::kAvx2
                                                           : Kernel::kPortable;
  return best;
}

}  // namespace polylidar::detail
