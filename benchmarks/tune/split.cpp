#include "benchmarks/tune/split.hpp"

#include "datasets/random.hpp"

namespace hullbench::tune {

std::string to_string(Side side) {
  return side == Side::kTraining ? "training" : "test";
}

Side side_of(const std::string& shape, std::uint64_t seed) {
  return derive_seed(seed, "side/" + shape) % 2 == 0 ? Side::kTraining : Side::kTest;
}

}  // namespace hullbench::tune
