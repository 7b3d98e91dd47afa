#include "datasets/portable_math.hpp"

#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <span>
#include <stdexcept>

namespace hullbench {

using polylidar::Point;

namespace {

/// Coefficients of x^3, x^5 ... x^17 in sin x, times 1 / x.
constexpr double kSine[] = {-1.0 / 6,        1.0 / 120,        -1.0 / 5040,          1.0 / 362880,
                            -1.0 / 39916800, 1.0 / 6227020800, -1.0 / 1307674368000, 1.0 / 355687428096000};

/// Coefficients of x^2, x^4 ... x^16 in cos x.
constexpr double kCosine[] = {-1.0 / 2,       1.0 / 24,        -1.0 / 720,         1.0 / 40320,
                              -1.0 / 3628800, 1.0 / 479001600, -1.0 / 87178291200, 1.0 / 20922789888000};

/// Coefficients of s^2, s^4 ... s^22 in artanh(s) / s.
constexpr double kArtanh[] = {1.0 / 3,  1.0 / 5,  1.0 / 7,  1.0 / 9,  1.0 / 11, 1.0 / 13,
                              1.0 / 15, 1.0 / 17, 1.0 / 19, 1.0 / 21, 1.0 / 23};

/// The upper 33 bits of log 2, so that an exponent times it is exact, and the rest.
constexpr double kLog2High = 0x1.62e42fefp-1;
constexpr double kLog2Low = 0x1.473de6af278edp-34;

/// coefficients[0] * z + coefficients[1] * z^2 + ...
double series(std::span<const double> coefficients, double z) {
  double sum = 0;
  for (std::size_t i = coefficients.size(); i-- > 0;) sum = (sum + coefficients[i]) * z;
  return sum;
}

}  // namespace

Point unit_vector(double turns) {
  if (!std::isfinite(turns)) throw std::invalid_argument("an angle must be a finite number of turns");
  const double part = turns - std::round(turns);
  const double quarters = std::round(4 * part);
  const double angle = 2 * std::numbers::pi * (part - quarters / 4);
  const double square = angle * angle;
  const double cosine = 1 + series(kCosine, square);
  const double sine = angle + angle * series(kSine, square);
  switch (static_cast<int>(quarters)) {
    case 0:
      return {cosine, sine};
    case 1:
      return {-sine, cosine};
    case -1:
      return {sine, -cosine};
    default:
      return {-cosine, -sine};
  }
}

double natural_log(double x) {
  if (!(x > 0) || !std::isfinite(x)) {
    throw std::invalid_argument("only a positive, finite number has a logarithm");
  }
  int exponent = 0;
  double mantissa = std::frexp(x, &exponent);
  if (mantissa < 0.5 * std::numbers::sqrt2) {
    mantissa *= 2;
    --exponent;
  }
  const double s = (mantissa - 1) / (mantissa + 1);
  const double log_mantissa = 2 * (s + s * series(kArtanh, s * s));
  return exponent * kLog2High + (exponent * kLog2Low + log_mantissa);
}

}  // namespace hullbench
