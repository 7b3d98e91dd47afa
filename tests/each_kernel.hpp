// Tests that run once for every kernel; ctest lists them one by one.
#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "core/src/kernels.hpp"

namespace polylidar::detail {

inline std::string kernel_name(Kernel kernel) {
  if (kernel == Kernel::kAvx512) return "avx512";
  return kernel == Kernel::kAvx2 ? "avx2" : "portable";
}

/// What GoogleTest says of it.
// NOLINTNEXTLINE(readability-identifier-naming): GoogleTest calls it
inline void PrintTo(Kernel kernel, std::ostream* out) {
  *out << kernel_name(kernel);
}

}  // namespace polylidar::detail

namespace polylidar::testing {

/// Its parameter is a kernel that this processor has; the tests of others are skipped, and "make test" says
/// so.
class KernelTest : public ::testing::TestWithParam<detail::Kernel> {
 protected:
  void SetUp() override {
    if (!detail::is_supported(GetParam())) {
      GTEST_SKIP() << "skipped: this processor or this build has no kernel "
                   << detail::kernel_name(GetParam());
    }
  }
};

inline auto each_kernel() {
  return ::testing::Values(detail::Kernel::kPortable, detail::Kernel::kAvx2, detail::Kernel::kAvx512);
}

inline std::string name_of_kernel_test(const ::testing::TestParamInfo<detail::Kernel>& tested) {
  return detail::kernel_name(tested.param);
}

}  // namespace polylidar::testing
