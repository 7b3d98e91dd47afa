#include "datasets/random.hpp"

#include <bit>
#include <cmath>
#include <stdexcept>
#include <string>

#include "datasets/portable_math.hpp"
#include "datasets/sha256.hpp"

namespace hullbench {

std::uint64_t derive_seed(std::uint64_t seed, std::string_view label) {
  std::string bytes;
  for (unsigned shift = 0; shift < 64; shift += 8) bytes += static_cast<char>((seed >> shift) & 0xFFU);
  bytes += label;
  const std::string hex = sha256_hex(bytes);
  std::uint64_t derived = 0;
  for (std::size_t byte = 8; byte-- > 0;) {
    derived = (derived << 8U) | static_cast<std::uint64_t>(std::stoul(hex.substr(2 * byte, 2), nullptr, 16));
  }
  return derived;
}

std::uint64_t SplitMix64::next() {
  state_ += 0x9E3779B97F4A7C15U;
  std::uint64_t mixed = state_;
  mixed = (mixed ^ (mixed >> 30U)) * 0xBF58476D1CE4E5B9U;
  mixed = (mixed ^ (mixed >> 27U)) * 0x94D049BB133111EBU;
  return mixed ^ (mixed >> 31U);
}

Random::Random(std::uint64_t seed) : state_{} {
  // Four outputs in a row of SplitMix64 are never all 0: it gives every 64-bit value once in its period.
  SplitMix64 filler(seed);
  for (std::uint64_t& word : state_) word = filler.next();
}

Random::Random(const std::array<std::uint64_t, 4>& state) : state_(state) {
  if (state == std::array<std::uint64_t, 4>{}) {
    throw std::invalid_argument(
        "the random generator cannot start from a state of zeros; give it another one");
  }
}

std::uint64_t Random::next() {
  auto& [a, b, c, d] = state_;
  const std::uint64_t result = std::rotl(a + d, 23) + a;
  const std::uint64_t shifted = b << 17U;
  c ^= a;
  d ^= b;
  b ^= c;
  a ^= d;
  c ^= shifted;
  d = std::rotl(d, 45);
  return result;
}

double Random::uniform() {
  // The upper 53 bits, because a double holds no more; both steps are exact.
  return static_cast<double>(next() >> 11U) * 0x1p-53;
}

double Random::between(double low, double high) {
  return low + (high - low) * uniform();
}

double Random::normal() {
  double x = 0;
  double square = 0;
  // The centre is refused because it has no direction; its logarithm is infinite.
  while (square == 0 || square >= 1) {
    x = between(-1, 1);
    const double y = between(-1, 1);
    square = x * x + y * y;
  }
  return x * std::sqrt(-2 * natural_log(square) / square);
}

std::uint64_t Random::below(std::uint64_t bound) {
  if (bound == 0)
    throw std::invalid_argument("there is no integer below 0 to draw; give a bound of at least 1");
  // The first 2^64 mod bound values are refused: the rest divides evenly among the remainders.
  const std::uint64_t refused = (0 - bound) % bound;
  std::uint64_t drawn = next();
  while (drawn < refused) drawn = next();
  return drawn % bound;
}

}  // namespace hullbench
