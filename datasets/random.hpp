// The project's own random numbers: the same bits on every machine, which the standard library's
// distributions do not promise. Integer arithmetic and correctly rounded steps only.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace hullbench {

/// A 64-bit seed that is independent of `seed` and of what any other label gives: the first 8 bytes,
/// little-endian, of the SHA-256 of the seed's 8 little-endian bytes followed by the label. Gives every data
/// set, hole set and sample its own stream.
std::uint64_t derive_seed(std::uint64_t seed, std::string_view label);

/// SplitMix64 (Steele, Lea, Flood: Fast Splittable Pseudorandom Number Generators, OOPSLA 2014). Used only to
/// fill the state of Random from one seed.
class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next();

 private:
  std::uint64_t state_;
};

/// xoshiro256++ 1.0 (Blackman, Vigna: Scrambled Linear Pseudorandom Number Generators, ACM TOMS 47(4), 2021)
/// with the distributions this project needs.
class Random {
 public:
  /// The state is the first four outputs of SplitMix64 from `seed`. Every seed is good, 0 too.
  explicit Random(std::uint64_t seed);
  /// Starts from a state, as the published generator does. All zeros is the one state it cannot leave:
  /// std::invalid_argument.
  explicit Random(const std::array<std::uint64_t, 4>& state);

  /// Uniform over all 64-bit integers.
  std::uint64_t next();
  /// Uniform over the 2^53 multiples of 2^-53 in [0, 1).
  double uniform();
  /// `low` + (`high` - `low`) * uniform(): from `low` to `high`, which must be finite; which of the ends can
  /// come out is up to the rounding.
  double between(double low, double high);
  /// Standard normal, by the polar method (Marsaglia, Bray: A Convenient Method for Generating Normal
  /// Variables, SIAM Review 6(3), 1964). Takes two uniform() for each point it tries, 2.5 on average, and
  /// keeps nothing: the second variable that the method offers is dropped, so the state stays the
  /// generator's alone. The largest magnitude that can come out is 12.01.
  double normal();
  /// Uniform over 0 .. bound - 1, without bias. std::invalid_argument when `bound` is 0.
  std::uint64_t below(std::uint64_t bound);

 private:
  std::array<std::uint64_t, 4> state_;
};

}  // namespace hullbench
