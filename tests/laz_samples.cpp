#include "tests/laz_samples.hpp"

#include <array>
#include <bit>
#include <limits>
#include <random>

#include "tests/las_file.hpp"

namespace hullbench::testing {
namespace {

/// What a point record has, in the widest types of any format.
struct Fields {
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::int32_t z = 0;
  unsigned intensity = 0;
  unsigned number = 1;
  unsigned returns = 1;
  unsigned direction = 0;
  unsigned channel = 0;
  unsigned flags = 0;
  unsigned classification = 0;
  int angle = 0;
  unsigned user = 0;
  unsigned source = 0;
  double time = 0;
  std::array<unsigned, 4> colour{};
  unsigned extra = 0;
};

std::string byte(unsigned value) {
  std::string text(1, static_cast<char>(value));
  return text;
}

std::string two_bytes(unsigned value) {
  return bytes_of(static_cast<std::uint16_t>(value));
}

std::string record_of(const Fields& f, unsigned format, std::size_t size) {
  std::string record = bytes_of(f.x) + bytes_of(f.y) + bytes_of(f.z) + two_bytes(f.intensity);
  if (format < 6) {
    record += byte((f.number & 7U) | (f.returns & 7U) << 3U | f.direction << 6U);
    record += byte((f.classification & 31U) | f.flags << 5U);
    record += byte(static_cast<unsigned>(f.angle)) + byte(f.user) + two_bytes(f.source);
    if (format % 2 == 1) record += bytes_of(f.time);
  } else {
    record += byte((f.number & 15U) | (f.returns & 15U) << 4U);
    record += byte((f.flags & 15U) | f.channel << 4U | f.direction << 6U);
    record += byte(f.classification) + byte(f.user) + two_bytes(static_cast<unsigned>(f.angle * 30)) +
              two_bytes(f.source) + bytes_of(f.time);
  }
  if (format != 0 && format != 1 && format != 6) {
    for (std::size_t i = 0; i < (format == 8 ? 4U : 3U); ++i) record += two_bytes(f.colour[i]);
  }
  while (record.size() < size) record += byte(f.extra + static_cast<unsigned>(record.size()) % 3);
  return record;
}

class Samples {
 public:
  Samples(LazSample sample, unsigned seed) : sample_(sample), random_(seed) {}

  Fields next() {
    if (sample_ == LazSample::kExtremes) {
      leap();
    } else if (sample_ != LazSample::kConstant) {
      scan();
    }
    return fields_;
  }

 private:
  unsigned below(unsigned end) { return static_cast<unsigned>(random_()) % end; }
  int around(int most) { return static_cast<int>(below(2 * static_cast<unsigned>(most) + 1)) - most; }

  void leap() {
    constexpr std::array<std::int32_t, 6> kNumbers = {std::numeric_limits<std::int32_t>::min(),
                                                      std::numeric_limits<std::int32_t>::max(),
                                                      0,
                                                      -1,
                                                      1,
                                                      0x40000000};
    constexpr std::array<double, 7> kTimes = {0, -1e300, 1e300, 1e-300, 123456.789, -0.0, 3e9};
    const auto number = [&] { return kNumbers[below(kNumbers.size())]; };
    fields_ = {number(),
               number(),
               number(),
               below(2) * 65535,
               below(16),
               below(16),
               below(4),
               below(4),
               below(16),
               below(2) * 255,
               around(127),
               below(2) * 255,
               below(2) * 65535,
               kTimes[below(kTimes.size())],
               {below(2) * 65535, below(2) * 65535, below(2) * 65535, below(2) * 65535},
               below(2) * 255};
  }

  /// One more return of the pulse, or another pulse.
  void scan() {
    Fields& f = fields_;
    if (f.number < f.returns) {
      ++f.number;
    } else {
      f.number = 1;
      f.returns = below(4) == 0 ? 1 + below(15) : 1;
      if (sample_ == LazSample::kScan && below(3) == 0) f.channel = below(4);
      // Beams that alternate have times of their own.
      double& time = times_[below(50) == 0 ? below(4) : f.channel];
      // At times the pulses get slower or faster, or go back.
      constexpr std::array<double, 6> kSteps = {1e-5, 1e-9, 1e-2, -1e-5, -3e-4, 2e-6};
      if (below(60) == 0) step_ = kSteps[below(kSteps.size())];
      time += step_ * (below(20) == 0 ? around(300) : 1) + (below(3) == 0 ? 1e-9 * around(100) : 0);
      if (below(1000) == 0) time += 1e4;
      f.time = below(15) == 0 ? f.time : time;
      if (below(10) == 0) f.angle = around(90);
      if (below(100) == 0) f.direction ^= below(4);
    }
    f.x += 20 + around(5);
    f.y += around(30);
    f.z = 10'000 - 500 * static_cast<int>(f.number) + around(50);
    f.intensity = 1000 + below(200);
    if (below(8) == 0) f.classification = below(32);
    if (below(40) == 0) f.flags = below(16);
    if (below(20) == 0) f.user = below(256);
    if (below(200) == 0) f.source = below(65536);
    const unsigned grey = below(65536);
    const bool is_grey = below(5) == 0;
    for (unsigned& c : f.colour) c = is_grey ? grey : (c + below(600)) & 65535U;
    f.extra = below(4) == 0 ? below(256) : f.extra;
  }

  LazSample sample_;
  std::mt19937 random_;
  Fields fields_;
  double step_ = 1e-5;
  std::array<double, 4> times_ = {100'000, 200'000, 3e8, 5};
};

}  // namespace

std::string las_sample(LazSample sample, unsigned format, unsigned extra_bytes, std::size_t count,
                       unsigned seed) {
  LasFile file;
  file.minor = format < 6 ? 2 : 4;
  file.format = format;
  file.extra_bytes = extra_bytes;
  file.points.resize(count);
  std::string text = file.text();
  const std::size_t size = LasFile::point_size(format) + extra_bytes;
  text.resize(text.size() - count * size);
  Samples samples(sample, seed);
  std::mt19937 random(seed);
  for (std::size_t i = 0; i < count; ++i) {
    std::string record = record_of(samples.next(), format, size);
    if (sample == LazSample::kWild) {
      for (char& any : record) any = static_cast<char>(random());
    }
    text += record;
  }
  return text;
}

}  // namespace hullbench::testing
