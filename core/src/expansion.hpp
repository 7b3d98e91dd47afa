// Exact arithmetic on floating-point expansions: sums of doubles that do not overlap.
//
// Source: J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
// Predicates", Discrete & Computational Geometry 18 (1997), sections 2.2 to 2.5. Everything here is exact as
// long as no operation overflows or underflows and rounding is to nearest even, without contraction to fused
// operations.
#pragma once

#include <cfloat>
#include <cmath>
#include <cstddef>

#ifdef __FAST_MATH__
#error "exact predicates need the order of operations that is written; compile without -ffast-math"
#endif

namespace polylidar::detail {

static_assert(
    FLT_EVAL_METHOD == 0,
    "exact predicates need doubles rounded to 53 bits; on 32-bit x86 compile with -msse2 -mfpmath=sse");

/// A rounded value `high` and its rounding error `low`: `high + low` is exact.
struct DoublePair {
  double high;
  double low;
};

inline DoublePair two_sum(double a, double b) {
  const double sum = a + b;
  const double b_virtual = sum - a;
  const double a_virtual = sum - b_virtual;
  return {sum, (a - a_virtual) + (b - b_virtual)};
}

/// As two_sum, for |a| >= |b| or a == 0.
inline DoublePair fast_two_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// The upper 26 and the lower 26 bits of `a`; 2^27 + 1 is the splitting constant for 53-bit doubles.
inline DoublePair split(double a) {
  constexpr double kSplitter = 134217729.0;
  const double c = kSplitter * a;
  const double high = c - (c - a);
  return {high, a - high};
}

inline DoublePair two_product(double a, double b) {
  const double product = a * b;
  const DoublePair as = split(a);
  const DoublePair bs = split(b);
  const double error = product - as.high * bs.high - as.low * bs.high - as.high * bs.low;
  return {product, as.low * bs.low - error};
}

/// A number as the exact sum of at most `Capacity` doubles, smallest magnitude first, without zeros.
/// `size` 0 is the number 0.
template <std::size_t Capacity>
struct Expansion {
  double term[Capacity];  // left uninitialised: only the first `size` are ever read
  std::size_t size = 0;

  void push(double value) {
    if (value != 0) term[size++] = value;
  }

  /// The sign is the exact number's: the largest term outweighs all others together.
  double sign() const { return size == 0 ? 0.0 : term[size - 1]; }
};

inline Expansion<2> difference(double a, double b) {
  const DoublePair pair = two_sum(a, -b);
  Expansion<2> result;
  result.push(pair.low);
  result.push(pair.high);
  return result;
}

/// Shewchuk's fast expansion sum with zero elimination: merges by magnitude, then sums up with one carry.
template <std::size_t M, std::size_t N>
Expansion<M + N> sum(const Expansion<M>& e, const Expansion<N>& f) {
  Expansion<M + N> result;
  if (e.size + f.size == 0) return result;
  std::size_t i = 0;
  std::size_t j = 0;
  const auto next = [&] {
    const bool from_e = j == f.size || (i < e.size && std::abs(e.term[i]) < std::abs(f.term[j]));
    return from_e ? e.term[i++] : f.term[j++];
  };
  double carry = next();
  if (i < e.size || j < f.size) {
    const double second = next();
    const DoublePair first_pair = fast_two_sum(second, carry);
    result.push(first_pair.low);
    carry = first_pair.high;
  }
  while (i < e.size || j < f.size) {
    const DoublePair pair = two_sum(carry, next());
    result.push(pair.low);
    carry = pair.high;
  }
  result.push(carry);
  return result;
}

template <std::size_t N>
Expansion<N> negative(Expansion<N> e) {
  for (std::size_t i = 0; i < e.size; ++i) e.term[i] = -e.term[i];
  return e;
}

/// Shewchuk's scale expansion with zero elimination.
template <std::size_t N>
Expansion<2 * N> scale(const Expansion<N>& e, double factor) {
  Expansion<2 * N> result;
  if (e.size == 0) return result;
  const DoublePair first = two_product(e.term[0], factor);
  result.push(first.low);
  double carry = first.high;
  for (std::size_t i = 1; i < e.size; ++i) {
    const DoublePair product = two_product(e.term[i], factor);
    const DoublePair low_sum = two_sum(carry, product.low);
    result.push(low_sum.low);
    const DoublePair high_sum = fast_two_sum(product.high, low_sum.high);
    result.push(high_sum.low);
    carry = high_sum.high;
  }
  result.push(carry);
  return result;
}

/// The exact product. Its size is what the number needs, so small integers stay short.
template <std::size_t M, std::size_t N>
Expansion<2 * M * N> product(const Expansion<M>& e, const Expansion<N>& f) {
  Expansion<2 * M * N> result;
  for (std::size_t i = 0; i < f.size; ++i) {
    const Expansion<2 * M> part = scale(e, f.term[i]);
    const auto total = sum(result, part);
    result.size = total.size;
    for (std::size_t k = 0; k < total.size; ++k) result.term[k] = total.term[k];
  }
  return result;
}

}  // namespace polylidar::detail
