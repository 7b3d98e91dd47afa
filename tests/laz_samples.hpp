// LAS files whose points have something in every byte, to be compressed.
#pragma once

#include <cstdint>
#include <string>

namespace hullbench::testing {

enum class LazSample {
  kScan,      ///< lines of a scanner: small steps, several returns, beams that alternate, gaps in time
  kOneBeam,   ///< the same with one scanner channel only
  kWild,      ///< any bytes
  kExtremes,  ///< the least and greatest numbers, and leaps between them
  kConstant   ///< all points are the same
};

/// LAS 1.2 or, for point formats from 6 on, 1.4, with so many points; the same bytes for the same `seed`.
std::string las_sample(LazSample sample, unsigned format, unsigned extra_bytes, std::size_t count,
                       unsigned seed);

}  // namespace hullbench::testing
