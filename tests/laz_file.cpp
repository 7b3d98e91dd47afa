// By the same sources as the decoder: M. Isenburg, "LASzip: lossless compression of lidar data",
// Photogrammetric Engineering and Remote Sensing 79(2), 2013; A. Said, HP Laboratories report HPL-2004-76;
// ASPRS, "LAZ Specification" 1.4.
#include "tests/laz_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>
#include <stdexcept>

#include "tests/point_file_texts.hpp"

namespace hullbench::testing {
namespace {

template <typename Number>
Number number_at(const std::string& bytes, std::size_t place) {
  Number number{};
  if (place + sizeof number > bytes.size()) throw std::out_of_range("no such byte");
  std::memcpy(&number, bytes.data() + place, sizeof number);
  return number;
}

/// How often each symbol came, and where its interval starts.
struct Model {
  explicit Model(unsigned symbols) : counts(symbols, 1), starts(symbols), cycle((symbols + 6) / 2) {
    total = symbols;
    find_starts();
  }

  void add(unsigned symbol) {
    ++counts[symbol];
    if (++since_refresh < cycle) return;
    total += cycle;
    if (total > 32768) {
      total = 0;
      for (std::uint32_t& count : counts) total += count = (count + 1) / 2;
    }
    find_starts();
    since_refresh = 0;
    cycle = std::min<std::uint32_t>(cycle * 5 / 4, static_cast<std::uint32_t>(counts.size() + 6) * 8);
  }

  void find_starts() {
    std::uint32_t sum = 0;
    for (std::size_t s = 0; s < counts.size(); ++s) {
      starts[s] = 0x80000000U / total * sum >> 16U;
      sum += counts[s];
    }
  }

  std::vector<std::uint32_t> counts;
  std::vector<std::uint32_t> starts;  ///< in units of 2^-15
  std::uint32_t cycle;
  std::uint32_t total = 0;
  std::uint32_t since_refresh = 0;
};

struct ModelOfBit {
  void add(bool one) {
    if (!one) ++zeros;
    if (++since_refresh < cycle) return;
    total += cycle;
    if (total > 8192) {
      total = (total + 1) / 2;
      zeros = (zeros + 1) / 2;
      if (zeros == total) ++total;
    }
    start_of_one = 0x80000000U / total * zeros >> 18U;
    since_refresh = 0;
    cycle = std::min(cycle * 5 / 4, 64U);
  }

  std::uint32_t zeros = 1;
  std::uint32_t total = 2;
  std::uint32_t start_of_one = 4096;
  std::uint32_t cycle = 4;
  std::uint32_t since_refresh = 0;
};

class Encoder {
 public:
  void symbol(Model& model, unsigned symbol) {
    const std::uint32_t unit = length_ >> 15U;
    const std::uint32_t start = model.starts.at(symbol) * unit;
    const bool is_last = symbol + 1 == model.starts.size();
    take(start, (is_last ? length_ : model.starts[symbol + 1] * unit) - start);
    model.add(symbol);
  }

  void bit(ModelOfBit& model, bool one) {
    const std::uint32_t start = model.start_of_one * (length_ >> 13U);
    take(one ? start : 0, one ? length_ - start : start);
    model.add(one);
  }

  void bits(std::uint32_t number, unsigned count) {
    if (count > 19) {
      bits(number & 0xFFFFU, 16);
      number >>= 16U;
      count -= 16;
    }
    const std::uint32_t unit = length_ >> count;
    take(number * unit, unit);
  }

  /// As few bytes as the decoder needs, and as many as it takes.
  std::string finish() {
    const bool needs_one = length_ > 2 * kLeastLength;
    take(needs_one ? kLeastLength : kLeastLength / 2, needs_one ? kLeastLength / 2 : kLeastLength / 512);
    return bytes_ + std::string(needs_one ? 3 : 2, '\0');
  }

 private:
  static constexpr std::uint32_t kLeastLength = 1U << 24U;

  void take(std::uint32_t start, std::uint32_t length) {
    base_ += start;
    if (base_ < start) carry();
    for (length_ = length; length_ < kLeastLength; length_ <<= 8U, base_ <<= 8U) {
      bytes_ += static_cast<char>(base_ >> 24U);
    }
  }

  /// An overflow: one more in the bytes that are written.
  void carry() {
    auto last = bytes_.rbegin();
    for (; *last == '\xFF'; ++last) *last = '\0';
    *last = static_cast<char>(*last + 1);
  }

  std::uint32_t base_ = 0;
  std::uint32_t length_ = 0xFFFFFFFFU;
  std::string bytes_;
};

/// Numbers as corrections of predictions.
class NumberEncoder {
 public:
  NumberEncoder(unsigned bits, unsigned contexts) : bits_(bits), widths_(contexts, Model(bits + 1)) {
    for (unsigned k = 1; k <= bits; ++k) high_.emplace_back(1U << std::min(k, 8U));
  }

  void encode(Encoder& encoder, std::int32_t prediction, std::int32_t number, unsigned context) {
    const std::int64_t range = std::int64_t{1} << bits_;
    std::int64_t c = std::int64_t{number} - prediction;
    if (c < -range / 2) c += range;
    if (c >= range / 2) c -= range;
    width = 0;
    while (c < -((std::int64_t{1} << width) - 1) || c > std::int64_t{1} << width) ++width;
    encoder.symbol(widths_.at(context), width);
    if (width == 0) return encoder.bit(zero_or_one_, c == 1);
    if (width == 32) return;
    const auto place = static_cast<std::uint32_t>(c < 0 ? c + (std::int64_t{1} << width) - 1 : c - 1);
    if (width <= 8) return encoder.symbol(high_[width - 1], place);
    encoder.symbol(high_[width - 1], place >> (width - 8));
    encoder.bits(place & ((1U << (width - 8)) - 1), width - 8);
  }

  unsigned width = 0;  ///< of the last correction

 private:
  unsigned bits_;
  std::vector<Model> widths_;
  std::vector<Model> high_;
  ModelOfBit zero_or_one_;
};

/// LASzip's StreamingMedian5, by another way: sorted values of which the greatest or the least is dropped.
struct Median {
  void add(std::int32_t value) {
    const bool was_high = high;
    high = was_high ? value < values[2] : value <= values[2];
    values.erase(was_high ? values.end() - 1 : values.begin());
    values.insert(was_high ? std::upper_bound(values.begin(), values.end(), value)
                           : std::lower_bound(values.begin(), values.end(), value),
                  value);
  }

  std::vector<std::int32_t> values = {0, 0, 0, 0, 0};
  bool high = true;
};

std::int32_t difference(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) - static_cast<std::uint32_t>(b));
}

std::int32_t product(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) * static_cast<std::uint32_t>(b));
}

unsigned even(unsigned width, unsigned most) {
  return width < most ? width & ~1U : most;
}

/// x, y and z of a point and of the last one.
class PlaceEncoder {
 public:
  explicit PlaceEncoder(std::size_t contexts) : x_medians_(contexts), y_medians_(contexts) {}

  void encode(Encoder& encoder, const std::string& last, const std::string& point, std::size_t context,
              bool is_single) {
    const auto step = [&](std::size_t at, NumberEncoder& numbers, Median& median, unsigned of_width) {
      const std::int32_t by =
          difference(number_at<std::int32_t>(point, at), number_at<std::int32_t>(last, at));
      numbers.encode(encoder, median.values[2], by, of_width + (is_single ? 1 : 0));
      median.add(by);
    };
    step(0, x_, x_medians_.at(context), 0);
    step(4, y_, y_medians_.at(context), even(x_.width, 20));
  }

  void encode_height(Encoder& encoder, std::int32_t last, std::int32_t z, bool is_single) {
    z_.encode(encoder, last, z, even((x_.width + y_.width) / 2, 18) + (is_single ? 1 : 0));
  }

 private:
  NumberEncoder x_{32, 2};
  NumberEncoder y_{32, 22};
  NumberEncoder z_{32, 20};
  std::vector<Median> x_medians_;
  std::vector<Median> y_medians_;
};

/// Times of formats 0 to 3, or of 6 to 8, where one that does not change is not written.
class TimeEncoder {
 public:
  TimeEncoder(bool is_layered, std::int64_t first)
      : first_(is_layered ? 0 : 1), same_step_(5 + first_), multiple_(515 + first_) {
    times_[0] = first;
  }

  void encode(Encoder& encoder, std::int64_t time) {
    const std::int64_t by = wrapped(time, times_[current_]);
    const bool fits = by == static_cast<std::int32_t>(by);
    const auto step = static_cast<std::int32_t>(by);
    if (first_ == 1 && by == 0) {
      encoder.symbol(steps_[current_] == 0 ? same_step_ : multiple_, steps_[current_] == 0 ? 0 : 511);
    } else if (!fits) {
      encode_far(encoder, time);
    } else if (steps_[current_] == 0) {
      encoder.symbol(same_step_, first_);
      numbers_.encode(encoder, 0, step, 0);
      steps_[current_] = step;
      extremes_[current_] = 0;
    } else {
      encode_multiple(encoder, step);
    }
    times_[current_] = time;
  }

 private:
  static std::int64_t wrapped(std::int64_t a, std::int64_t b) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) - static_cast<std::uint64_t>(b));
  }

  void encode_far(Encoder& encoder, std::int64_t time) {
    Model& model = steps_[current_] == 0 ? same_step_ : multiple_;
    const unsigned far = steps_[current_] == 0 ? 1 + first_ : 511 + first_;
    for (unsigned further = 1; further < 4; ++further) {
      const std::int64_t by = wrapped(time, times_[(current_ + further) % 4]);
      if (by != static_cast<std::int32_t>(by)) continue;
      encoder.symbol(model, far + further);
      current_ = (current_ + further) % 4;
      return encode(encoder, time);
    }
    encoder.symbol(model, far);
    const auto upper = [](std::int64_t of) { return static_cast<std::int32_t>(of >> 32U); };
    numbers_.encode(encoder, upper(times_[current_]), upper(time), 8);
    encoder.bits(static_cast<std::uint32_t>(time), 32);
    newest_ = current_ = (newest_ + 1) % 4;
    steps_[current_] = 0;
    extremes_[current_] = 0;
  }

  void encode_multiple(Encoder& encoder, std::int32_t step) {
    const std::int32_t last = steps_[current_];
    const float ratio = static_cast<float>(step) / static_cast<float>(last);
    const auto multiple = static_cast<int>(std::clamp(ratio + (ratio < 0 ? -0.5F : 0.5F), -20.F, 600.F));
    const auto code = [&](unsigned symbol, std::int32_t prediction, unsigned context) {
      encoder.symbol(multiple_, symbol);
      numbers_.encode(encoder, prediction, step, context);
    };
    bool is_extreme = false;
    if (multiple == 1) {
      code(1, last, 1);
      extremes_[current_] = 0;
    } else if (multiple == 0) {
      code(0, 0, 7);
      is_extreme = true;
    } else if (multiple > 0 && multiple < 500) {
      code(static_cast<unsigned>(multiple), product(multiple, last), multiple < 10 ? 2 : 3);
    } else if (multiple > 0) {
      code(500, product(500, last), 4);
      is_extreme = true;
    } else if (multiple > -10) {
      code(static_cast<unsigned>(500 - multiple), product(multiple, last), 5);
    } else {
      code(510, product(-10, last), 6);
      is_extreme = true;
    }
    if (!is_extreme || ++extremes_[current_] <= 3) return;
    steps_[current_] = step;
    extremes_[current_] = 0;
  }

  unsigned first_;  ///< symbol that says that there is a step
  Model same_step_;
  Model multiple_;
  NumberEncoder numbers_{32, 9};
  std::array<std::int64_t, 4> times_{};
  std::array<std::int32_t, 4> steps_{};
  std::array<unsigned, 4> extremes_{};
  unsigned current_ = 0;
  unsigned newest_ = 0;
};

/// Six bytes of red, green and blue at `at`.
class ColourEncoder {
 public:
  void encode(Encoder& encoder, const std::string& last, const std::string& point, std::size_t at) {
    const auto byte = [at](const std::string& record, std::size_t i) {
      return static_cast<int>(static_cast<unsigned char>(record[at + i]));
    };
    unsigned changes = 0;
    for (unsigned i = 0; i < 6; ++i) changes |= (byte(last, i) != byte(point, i) ? 1U : 0U) << i;
    const auto is_as_red = [&](std::size_t i) { return point.substr(at + i, 2) == point.substr(at, 2); };
    if (!is_as_red(2) || !is_as_red(4)) changes |= 64U;
    encoder.symbol(changes_, changes);
    const auto code = [&](unsigned i, int prediction) {
      if ((changes >> i & 1U) == 0) return;
      encoder.symbol(bytes_[i],
                     static_cast<unsigned>(byte(point, i) - std::clamp(prediction, 0, 255)) & 255U);
    };
    const auto step = [&](unsigned i) { return byte(point, i) - byte(last, i); };
    code(0, byte(last, 0));
    code(1, byte(last, 1));
    if ((changes & 64U) == 0) return;
    for (const unsigned i : {0U, 1U}) {
      code(2 + i, step(i) + byte(last, 2 + i));
      code(4 + i, (step(i) + step(2 + i)) / 2 + byte(last, 4 + i));
    }
  }

 private:
  Model changes_{128};
  std::vector<Model> bytes_{6, Model(256)};
};

/// Bytes from `at` to the end, each as its difference; layered ones have an encoder each.
class BytesEncoder {
 public:
  explicit BytesEncoder(std::size_t count) : models_(count, Model(256)) {}

  template <typename EncoderOf>
  void encode(const EncoderOf& encoder_of, const std::string& last, const std::string& point,
              std::size_t at) {
    for (std::size_t i = 0; i < models_.size(); ++i) {
      encoder_of(i).symbol(models_[i], static_cast<unsigned>(point[at + i] - last[at + i]) & 255U);
    }
  }

 private:
  std::vector<Model> models_;
};

/// Models that are made when a symbol needs one of them.
struct Models {
  Model& operator[](unsigned context) { return models.try_emplace(context, symbols).first->second; }
  unsigned symbols;
  std::map<unsigned, Model> models = {};
};

constexpr std::array<std::array<unsigned, 8>, 8> kContexts = {{{15, 14, 13, 12, 11, 10, 9, 8},
                                                               {14, 0, 1, 3, 6, 10, 10, 9},
                                                               {13, 1, 2, 4, 7, 11, 11, 10},
                                                               {12, 3, 4, 5, 8, 12, 12, 11},
                                                               {11, 6, 7, 8, 9, 13, 13, 12},
                                                               {10, 10, 11, 12, 13, 14, 14, 13},
                                                               {9, 10, 11, 12, 13, 14, 15, 14},
                                                               {8, 9, 10, 11, 12, 13, 14, 15}}};

/// The 16 x 16 contexts of formats 6 to 8, row by row.
constexpr const char* kContexts6 =
    "0123453445555555"
    "1013333333333333"
    "2124444444433333"
    "3345444444444444"
    "4344544444444444"
    "5344454444444444"
    "3344445444444444"
    "4344444544444444"
    "4344444454444444"
    "5344444445444444"
    "5344444444544444"
    "5334444444455444"
    "5334444444455544"
    "5334444444445554"
    "5334444444444555"
    "5334444444444455";

std::size_t least_size(unsigned format) {
  return std::array<std::size_t, 9>{20, 28, 26, 34, 0, 0, 30, 36, 38}.at(format);
}

/// The points of a chunk, formats 0 to 3.
std::string pointwise_chunk(const std::vector<std::string>& points, unsigned format) {
  const auto byte = [](const std::string& record, std::size_t at) {
    return static_cast<unsigned>(static_cast<unsigned char>(record[at]));
  };
  Encoder encoder;
  Model changes(64);
  Models returns{256};
  Models classes{256};
  Models users{256};
  std::vector<Model> angles(2, Model(256));
  NumberEncoder intensities(16, 4);
  NumberEncoder sources(16, 1);
  PlaceEncoder places(16);
  std::array<std::uint16_t, 16> last_intensities{};
  std::array<std::int32_t, 8> last_heights{};
  const bool has_time = format == 1 || format == 3;
  const std::size_t colour_at = has_time ? 28 : 20;
  TimeEncoder times(false, has_time ? number_at<std::int64_t>(points[0], 20) : 0);
  ColourEncoder colours;
  BytesEncoder extra(points[0].size() - least_size(format));
  for (std::size_t i = 1; i < points.size(); ++i) {
    const std::string& last = points[i - 1];
    const std::string& point = points[i];
    const unsigned number = byte(point, 14) & 7U;
    const unsigned count = byte(point, 14) >> 3U & 7U;
    const unsigned context = kContexts[count][number];
    const auto intensity = number_at<std::uint16_t>(point, 12);
    const auto source = number_at<std::uint16_t>(point, 18);
    const bool has_new_source = source != number_at<std::uint16_t>(last, 18);
    const auto differs = [&](std::size_t at, unsigned bit) {
      return byte(point, at) != byte(last, at) ? bit : 0U;
    };
    const unsigned changed = differs(14, 32) | (intensity != last_intensities[context] ? 16U : 0U) |
                             differs(15, 8) | differs(16, 4) | differs(17, 2) | (has_new_source ? 1U : 0U);
    encoder.symbol(changes, changed);
    if ((changed & 32U) != 0) encoder.symbol(returns[byte(last, 14)], byte(point, 14));
    if ((changed & 16U) != 0) {
      intensities.encode(encoder, last_intensities[context], intensity, std::min(context, 3U));
      last_intensities[context] = intensity;
    }
    if ((changed & 8U) != 0) encoder.symbol(classes[byte(last, 15)], byte(point, 15));
    if ((changed & 4U) != 0) {
      encoder.symbol(angles[byte(point, 14) >> 6U & 1U], (byte(point, 16) - byte(last, 16)) & 255U);
    }
    if ((changed & 2U) != 0) encoder.symbol(users[byte(last, 17)], byte(point, 17));
    if ((changed & 1U) != 0) sources.encode(encoder, number_at<std::uint16_t>(last, 18), source, 0);
    places.encode(encoder, last, point, context, count == 1);
    std::int32_t& height = last_heights.at(count > number ? count - number : number - count);
    places.encode_height(encoder, height, number_at<std::int32_t>(point, 8), count == 1);
    height = number_at<std::int32_t>(point, 8);
    if (has_time) times.encode(encoder, number_at<std::int64_t>(point, 20));
    if (format >= 2) colours.encode(encoder, last, point, colour_at);
    extra.encode([&](std::size_t) -> Encoder& { return encoder; }, last, point, least_size(format));
  }
  return points[0] + encoder.finish();
}

/// One of the four scanner channels of formats 6 to 8.
struct Channel {
  Channel(const std::string& record, std::size_t extra_bytes)
      : last(record), times(true, number_at<std::int64_t>(record, 22)), extra(extra_bytes) {
    heights.fill(number_at<std::int32_t>(record, 8));
    last_intensities.fill(number_at<std::uint16_t>(record, 12));
  }

  std::string last;
  bool had_new_time = false;
  std::vector<Model> changes{8, Model(128)};
  Model channel{3};
  Models counts{16};
  Models numbers{16};
  Model number_steps{13};
  PlaceEncoder places{12};
  std::array<std::int32_t, 8> heights{};
  Models classes{256};
  Models flags{64};
  std::array<std::uint16_t, 8> last_intensities{};
  NumberEncoder intensities{16, 4};
  NumberEncoder angles{16, 2};
  Models users{256};
  NumberEncoder sources{16, 1};
  TimeEncoder times;
  ColourEncoder colours;
  Model infrared_changes{4};
  std::vector<Model> infrared{2, Model(256)};
  BytesEncoder extra;
};

class LayeredChunk {
 public:
  LayeredChunk(const std::vector<std::string>& points, unsigned format)
      : points_(points),
        format_(format),
        extra_bytes_(points[0].size() - least_size(format)),
        layers_(kExtra + format - 6 + extra_bytes_) {}

  std::string encode() {
    current_ = channel_of(points_[0]);
    channels_.try_emplace(current_, points_[0], extra_bytes_);
    rest_channel_ = current_;
    last_rests_[current_] = points_[0];
    for (std::size_t i = 1; i < points_.size(); ++i) encode_point(points_[i]);
    std::string sizes;
    std::string bytes;
    for (std::size_t i = 0; i < layers_.size(); ++i) {
      const std::string layer = layers_[i].changes || i == 0 ? layers_[i].encoder.finish() : "";
      sizes += bytes_of(static_cast<std::uint32_t>(layer.size()));
      bytes += layer;
    }
    return points_[0] + bytes_of(static_cast<std::uint32_t>(points_.size())) + sizes + bytes;
  }

 private:
  enum Place : std::size_t { kXy, kZ, kClass, kFlags, kIntensity, kAngle, kUser, kSource, kTime, kExtra };

  struct Layer {
    Encoder encoder;
    bool changes = false;
  };

  static unsigned byte(const std::string& record, std::size_t at) {
    return static_cast<unsigned char>(record[at]);
  }
  static unsigned channel_of(const std::string& record) { return byte(record, 15) >> 4U & 3U; }
  static unsigned number_of(const std::string& record) { return byte(record, 14) & 15U; }
  static unsigned count_of(const std::string& record) { return byte(record, 14) >> 4U; }
  static unsigned flags_of(const std::string& record) {
    return (byte(record, 15) & 15U) | byte(record, 15) >> 6U << 4U;
  }
  static unsigned kind_of(const std::string& record) {
    return (number_of(record) == 1 ? 1U : 0U) + (number_of(record) >= count_of(record) ? 2U : 0U);
  }

  Encoder& layer(std::size_t place, bool changes) {
    layers_.at(place).changes |= changes;
    return layers_[place].encoder;
  }

  void encode_point(const std::string& point) {
    const unsigned next = channel_of(point);
    const auto known = channels_.find(next);
    const std::string last = known != channels_.end() ? known->second.last : channels_.at(current_).last;
    const auto differs = [&](std::size_t at, std::size_t size) {
      return point.compare(at, size, last, at, size) != 0;
    };
    const bool has_new_time = differs(22, 8);
    const bool has_new_angle = differs(18, 2);
    const bool has_new_source = differs(20, 2);
    const unsigned by = (number_of(point) + 16 - number_of(last)) % 16;
    const unsigned number_change = by == 0 ? 0 : by == 1 ? 1 : by == 15 ? 2 : 3;
    Channel& before = channels_.at(current_);
    Encoder& xy = layers_[kXy].encoder;
    xy.symbol(before.changes.at(kind_of(before.last) + (before.had_new_time ? 4 : 0)),
              (next != current_ ? 64U : 0U) | (has_new_source ? 32U : 0U) | (has_new_time ? 16U : 0U) |
                  (has_new_angle ? 8U : 0U) | (count_of(point) != count_of(last) ? 4U : 0U) | number_change);
    if (next != current_) {
      xy.symbol(before.channel, (next + 4 - current_) % 4 - 1);
      channels_.try_emplace(next, before.last, extra_bytes_);
      current_ = next;
    }
    Channel& channel = channels_.at(next);
    if (count_of(point) != count_of(last)) xy.symbol(channel.counts[count_of(last)], count_of(point));
    if (number_change == 3) {
      if (has_new_time) {
        xy.symbol(channel.numbers[number_of(last)], number_of(point));
      } else {
        xy.symbol(channel.number_steps, by - 2);
      }
    }
    const bool is_single = count_of(point) == 1;
    const unsigned time = has_new_time ? 1 : 0;
    const auto context = static_cast<unsigned>(kContexts6[count_of(point) * 16 + number_of(point)] - '0');
    channel.places.encode(xy, last, point, context * 2 + time, is_single);
    encode_layers(channel, last, point, time, has_new_angle, has_new_source);
    channel.last = point;
    channel.had_new_time = has_new_time;
  }

  void encode_layers(Channel& channel, const std::string& last, const std::string& point, unsigned time,
                     bool has_new_angle, bool has_new_source) {
    const unsigned kind = kind_of(point);
    const auto z = number_at<std::int32_t>(point, 8);
    const int level = std::abs(static_cast<int>(count_of(point)) - static_cast<int>(number_of(point)));
    std::int32_t& height = channel.heights[static_cast<std::size_t>(std::min(level, 7))];
    channel.places.encode_height(layer(kZ, z != number_at<std::int32_t>(last, 8)), height, z,
                                 count_of(point) == 1);
    height = z;
    layer(kClass, byte(point, 16) != byte(last, 16))
        .symbol(channel.classes[(byte(last, 16) & 31U) * 2 + (kind == 3 ? 1 : 0)], byte(point, 16));
    layer(kFlags, flags_of(point) != flags_of(last)).symbol(channel.flags[flags_of(last)], flags_of(point));
    const auto intensity = number_at<std::uint16_t>(point, 12);
    std::uint16_t& last_intensity = channel.last_intensities[kind * 2 + time];
    channel.intensities.encode(layer(kIntensity, intensity != number_at<std::uint16_t>(last, 12)),
                               last_intensity, intensity, kind);
    last_intensity = intensity;
    if (has_new_angle) {
      channel.angles.encode(layer(kAngle, true), number_at<std::uint16_t>(last, 18),
                            number_at<std::uint16_t>(point, 18), time);
    }
    layer(kUser, byte(point, 17) != byte(last, 17))
        .symbol(channel.users[byte(last, 17) / 4], byte(point, 17));
    if (has_new_source) {
      channel.sources.encode(layer(kSource, true), number_at<std::uint16_t>(last, 20),
                             number_at<std::uint16_t>(point, 20), 0);
    }
    if (time == 1) channel.times.encode(layer(kTime, true), number_at<std::int64_t>(point, 22));
    std::string& last_rest = this->last_rest();
    encode_rest(channel, last_rest, point);
    last_rest = point;
  }

  /// The point from which colour, infrared and extra bytes are predicted. Items of version 3 take that of the
  /// channel before, and change it, when a channel comes again; version 4 takes the channel's own.
  std::string& last_rest() {
    std::string& before = last_rests_[rest_channel_];
    rest_channel_ = current_;
    const auto [own, is_new] = last_rests_.try_emplace(current_, before);
    return is_new ? own->second : before;
  }

  void encode_rest(Channel& channel, const std::string& last, const std::string& point) {
    const auto differ = [&](std::size_t at, std::size_t size) {
      return point.compare(at, size, last, at, size) != 0;
    };
    std::size_t place = kExtra;
    if (format_ >= 7) channel.colours.encode(layer(place++, differ(30, 6)), last, point, 30);
    if (format_ == 8) {
      Encoder& encoder = layer(place++, differ(36, 2));
      encoder.symbol(channel.infrared_changes, (differ(36, 1) ? 1U : 0U) | (differ(37, 1) ? 2U : 0U));
      for (const std::size_t i : {0U, 1U}) {
        if (!differ(36 + i, 1)) continue;
        encoder.symbol(channel.infrared[i], (byte(point, 36 + i) - byte(last, 36 + i)) & 255U);
      }
    }
    const std::size_t at = least_size(format_);
    channel.extra.encode([&](std::size_t i) -> Encoder& { return layer(place + i, differ(at + i, 1)); }, last,
                         point, at);
  }

  const std::vector<std::string>& points_;
  unsigned format_;
  std::size_t extra_bytes_;
  std::vector<Layer> layers_;
  std::map<unsigned, Channel> channels_;
  unsigned current_ = 0;
  std::map<unsigned, std::string> last_rests_;  ///< channel -> the last point, as last_rest() knows it
  unsigned rest_channel_ = 0;
};

struct Item {
  std::uint16_t kind;
  std::size_t size;
};

std::string laz_record(unsigned format, std::size_t extra_bytes, const LazOptions& options) {
  const bool is_layered = format >= 6;
  std::vector<Item> items = {is_layered ? Item{10, 30} : Item{6, 20}};
  if (format == 1 || format == 3) items.push_back({7, 8});
  if (format == 2 || format == 3) items.push_back({8, 6});
  if (format == 7) items.push_back({11, 6});
  if (format == 8) items.push_back({12, 8});
  if (extra_bytes > 0) items.push_back({static_cast<std::uint16_t>(is_layered ? 14 : 0), extra_bytes});
  const int compressor = is_layered ? 3 : options.is_chunked ? 2 : 1;
  std::string record = bytes_of(static_cast<std::uint16_t>(compressor)) + bytes_of(std::uint16_t{0}) +
                       std::string("\3\4\1\0", 4) + bytes_of(std::uint32_t{0}) +
                       bytes_of(options.chunks.empty() ? options.chunk_size : 0xFFFFFFFFU) +
                       std::string(16, '\xFF') + bytes_of(static_cast<std::uint16_t>(items.size()));
  for (const Item& item : items) {
    record += bytes_of(item.kind) + bytes_of(static_cast<std::uint16_t>(item.size)) +
              bytes_of(static_cast<std::uint16_t>(is_layered ? 3 : 2));
  }
  std::string user = "laszip encoded";
  user.resize(16, '\0');
  return std::string(2, '\0') + user + bytes_of(std::uint16_t{22204}) +
         bytes_of(static_cast<std::uint16_t>(record.size())) + std::string(32, '\0') + record;
}

std::string chunk_table(const std::vector<std::uint32_t>& points, const std::vector<std::string>& chunks) {
  Encoder encoder;
  NumberEncoder numbers(32, 2);
  std::uint32_t last_points = 0;
  std::uint32_t last_size = 0;
  const auto encode = [&](std::uint32_t& last, std::uint32_t number, unsigned context) {
    numbers.encode(encoder, static_cast<std::int32_t>(last), static_cast<std::int32_t>(number), context);
    last = number;
  };
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    if (!points.empty()) encode(last_points, points[i], 0);
    encode(last_size, static_cast<std::uint32_t>(chunks[i].size()), 1);
  }
  return bytes_of(std::uint32_t{0}) + bytes_of(static_cast<std::uint32_t>(chunks.size())) + encoder.finish();
}

/// Appends to `text` chunks behind the place of their table, and the table. Returns the place of the table.
std::uint64_t append_points(std::string& text, const std::vector<std::string>& points, unsigned format,
                            const LazOptions& options) {
  std::vector<std::string> chunks;
  for (std::size_t begin = 0; begin < points.size();) {
    const std::size_t size = !options.is_chunked       ? points.size()
                             : !options.chunks.empty() ? options.chunks.at(chunks.size())
                                                       : options.chunk_size;
    const std::size_t end = std::min(begin + size, points.size());
    const std::vector<std::string> chunk(points.begin() + static_cast<std::ptrdiff_t>(begin),
                                         points.begin() + static_cast<std::ptrdiff_t>(end));
    chunks.push_back(format < 6 ? pointwise_chunk(chunk, format) : LayeredChunk(chunk, format).encode());
    begin = end;
  }
  std::uint64_t table_at = text.size() + 8;
  for (const std::string& chunk : chunks) table_at += chunk.size();
  if (options.is_chunked) text += bytes_of(options.has_table_place_at_end ? ~std::uint64_t{0} : table_at);
  for (const std::string& chunk : chunks) text += chunk;
  if (options.is_chunked) text += chunk_table(options.chunks, chunks);
  return table_at;
}

}  // namespace

std::string compressed(const std::string& las, const LazOptions& options) {
  constexpr std::size_t kPointsAt = 96;
  constexpr std::size_t kRecords = 100;
  constexpr std::size_t kFormat = 104;
  constexpr std::size_t kExtended = 235;
  const auto format = number_at<std::uint8_t>(las, kFormat);
  const auto size = number_at<std::uint16_t>(las, 105);
  const auto header_size = number_at<std::uint16_t>(las, 94);
  const auto points_at = number_at<std::uint32_t>(las, kPointsAt);
  const bool is_new = number_at<std::uint8_t>(las, 25) >= 4;
  const auto extended_at = is_new ? number_at<std::uint64_t>(las, kExtended) : 0;
  const std::size_t points_end = extended_at == 0 ? las.size() : extended_at;
  std::vector<std::string> points;
  for (std::size_t at = points_at; at + size <= points_end; at += size)
    points.push_back(las.substr(at, size));
  const std::string record = laz_record(format, size - least_size(format), options);
  const std::size_t new_points_at = points_at + record.size();
  std::string text = las.substr(0, header_size) + record + las.substr(header_size, points_at - header_size);
  const auto set = [&](std::size_t at, const std::string& bytes) { text.replace(at, bytes.size(), bytes); };
  set(kPointsAt, bytes_of(static_cast<std::uint32_t>(new_points_at)));
  set(kRecords, bytes_of(number_at<std::uint32_t>(las, kRecords) + 1));
  set(kFormat, std::string(1, static_cast<char>(format | 0x80U)));
  const std::uint64_t table_at = append_points(text, points, format, options);
  if (extended_at != 0) set(kExtended, bytes_of(std::uint64_t{text.size()}));
  text += las.substr(points_end);
  if (options.has_table_place_at_end) text += bytes_of(table_at);
  return text;
}

}  // namespace hullbench::testing
