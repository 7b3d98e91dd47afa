// Tests that run once for every kernel; ctest lists them one by one.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "core/src/kernels.hpp"

namespace polylidar::testing {

inline std::string kernel_name(detail::Kernel kernel) {
  if (kernel == detail::Kernel::kAvx512) return "avx512";
  return kernel == detail::Kernel::kAvx2 ? "avx2" : "portable";
}

/// Its parameter is a kernel that this processor has; the tests of others are skipped.
class KernelTest : public ::testing::TestWithParam<detail::Kernel> {
 protected:
  void SetUp() override {
    if (!detail::is_supported(GetParam())) {
      GTEST_SKIP() << "this processor or this build has no kernel " << kernel_name(GetParam());
    }
  }
};

inline auto each_kernel() {
  return ::testing::Values(detail::Kernel::kPortable, detail::Kernel::kAvx2, detail::Kernel::kAvx512);
}

inline std::string name_of_kernel_test(const ::testing::TestParamInfo<detail::Kernel>& tested) {
  return kernel_name(tested.param);
}

}  // namespace polylidar::testing
