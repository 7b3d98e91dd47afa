#include "benchmarks/plan/release_seed.hpp"

#include <string>

#include "datasets/sha256.hpp"

namespace hullbench::plan {

std::uint64_t release_seed() {
  constexpr int kHexadecimal = 16;
  return std::stoull(sha256_hex(std::string(kReleaseSentence)).substr(0, 8), nullptr, kHexadecimal);
}

}  // namespace hullbench::plan
