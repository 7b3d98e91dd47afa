// Sources of the format: M. Isenburg, "LASzip: lossless compression of lidar data", Photogrammetric
// Engineering and Remote Sensing 79(2), 2013, for formats 0 to 3; ASPRS, "LAZ Specification" 1.4, for the
// others. The tables of return contexts are those of LASzip.
//
// A point is predicted from those before it. Which of several models an attribute has depends on values that
// are known already, so much is unpacked here of which only its effect on later models, or its length,
// matters.
#include "tool/points/laz_chunk.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <vector>

#include "tool/points/arithmetic_decoder.hpp"
#include "tool/program/little_endian.hpp"

namespace polylidar::tool::point_files {
namespace {

using Bytes = std::span<const unsigned char>;

// Places in a point record.
constexpr std::size_t kReturnsAt = 14;
constexpr std::size_t kFlagsAt = 15;      // with the class in formats 0 to 3
constexpr std::size_t kClassAt = 16;      // of formats 6 to 8
constexpr std::size_t kUserDataAt = 17;   // of all formats
constexpr std::size_t kSourceAt = 18;     // of formats 0 to 3
constexpr std::size_t kSourceAt6 = 20;    // of formats 6 to 8
constexpr std::size_t kPoint10Size = 20;  // formats 0 to 3 without time and colour
constexpr std::size_t kPoint14Size = 30;  // format 6
constexpr std::size_t kTimeSize = 8;
constexpr std::size_t kColourSize = 6;
constexpr std::size_t kInfraredSize = 2;

/// Numbers of returns -> number of the return -> context, formats 0 to 3. It has all pairs, as some files
/// count from 0 or confuse the two.
constexpr std::array<std::array<std::uint8_t, 8>, 8> kReturnContext = {{{15, 14, 13, 12, 11, 10, 9, 8},
                                                                        {14, 0, 1, 3, 6, 10, 10, 9},
                                                                        {13, 1, 2, 4, 7, 11, 11, 10},
                                                                        {12, 3, 4, 5, 8, 12, 12, 11},
                                                                        {11, 6, 7, 8, 9, 13, 13, 12},
                                                                        {10, 10, 11, 12, 13, 14, 14, 13},
                                                                        {9, 10, 11, 12, 13, 14, 15, 14},
                                                                        {8, 9, 10, 11, 12, 13, 14, 15}}};

/// The same for formats 6 to 8.
constexpr std::array<std::array<std::uint8_t, 16>, 16> kReturnContext6 = {
    {{0, 1, 2, 3, 4, 5, 3, 4, 4, 5, 5, 5, 5, 5, 5, 5},
     {1, 0, 1, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3},
     {2, 1, 2, 4, 4, 4, 4, 4, 4, 4, 4, 3, 3, 3, 3, 3},
     {3, 3, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4},
     {4, 3, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4},
     {5, 3, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4},
     {3, 3, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4, 4},
     {4, 3, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4, 4},
     {4, 3, 4, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4, 4},
     {5, 3, 4, 4, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4, 4},
     {5, 3, 4, 4, 4, 4, 4, 4, 4, 4, 5, 4, 4, 4, 4, 4},
     {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 4, 4, 4},
     {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5, 4, 4},
     {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5, 4},
     {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5, 5},
     {5, 3, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 5, 5}}};

void put(char* to, std::uint32_t number, std::size_t size) {
  if constexpr (std::endian::native == std::endian::little) {
    std::memcpy(to, &number, size);
  } else {
    for (std::size_t i = 0; i < size; ++i) to[i] = static_cast<char>(number >> (8 * i));
  }
}

void reset(std::vector<SymbolModel>& models) {
  for (SymbolModel& model : models) model.reset();
}

/// Nearly the median of the last five differences, which costs less than the median.
class RunningMedian {
 public:
  std::int32_t get() const { return sorted_[2]; }

  /// Puts `difference` into its place and drops the greatest one, until that moved the middle to a smaller
  /// one; then the least one, until that moved it back.
  void add(std::int32_t difference) {
    auto& s = sorted_;
    std::size_t place = drops_greatest_ ? 4 : 0;
    if (drops_greatest_) {
      drops_greatest_ = difference < s[2];
      for (; place > 0 && difference < s[place - 1]; --place) s[place] = s[place - 1];
    } else {
      drops_greatest_ = difference <= s[2];
      for (; place < 4 && s[place + 1] < difference; ++place) s[place] = s[place + 1];
    }
    s[place] = difference;
  }

 private:
  std::array<std::int32_t, 5> sorted_{};
  bool drops_greatest_ = true;
};

/// x and y, whose differences from the last point are predicted by those in the same context.
class PlaceDecoder {
 public:
  explicit PlaceDecoder(std::size_t contexts) : medians_(contexts) {}

  void reset() {
    x_.reset();
    y_.reset();
    std::fill(medians_.begin(), medians_.end(), Medians());
  }

  void next(ArithmeticDecoder& decoder, std::size_t context, bool is_single, std::uint32_t& x,
            std::uint32_t& y) {
    Medians& medians = medians_[context];
    x += step(decoder, x_, is_single ? 1 : 0, medians.x);
    y += step(decoder, y_, width_context(x_.width(), 20, is_single), medians.y);
  }

  /// The context of z.
  unsigned context_of_height(bool is_single) const {
    return width_context((x_.width() + y_.width()) / 2, 18, is_single);
  }

 private:
  struct Medians {
    RunningMedian x;
    RunningMedian y;
  };

  static std::uint32_t step(ArithmeticDecoder& decoder, IntegerDecoder& numbers, unsigned context,
                            RunningMedian& median) {
    const std::uint32_t difference =
        numbers.number(decoder, static_cast<std::uint32_t>(median.get()), context);
    median.add(static_cast<std::int32_t>(difference));
    return difference;
  }

  static unsigned width_context(unsigned width, unsigned most, bool is_single) {
    return std::min(width & ~1U, most) + (is_single ? 1 : 0);
  }

  IntegerDecoder x_{32, 2};
  IntegerDecoder y_{32, 22};
  std::vector<Medians> medians_;
};

/// Passes over the times of formats 0 to 3. There are four sequences of times, as of beams that alternate,
/// each with the last step, of which a step is a multiple.
class TimeSkipper {
 public:
  void reset() {
    same_step_.reset();
    multiple_.reset();
    numbers_.reset();
    sequences_ = {};
    current_ = newest_ = 0;
  }

  void skip(ArithmeticDecoder& decoder) {
    // Damaged bytes could lead from one sequence to the next without end.
    while (is_elsewhere(decoder) && !decoder.is_broken()) {
    }
  }

 private:
  static constexpr unsigned kMostMultiple = 500;
  static constexpr unsigned kLeastMultiple = kMostMultiple + 10;  // -10; those between are -1 to -9
  static constexpr unsigned kSame = kLeastMultiple + 1;
  static constexpr unsigned kFarAway = kSame + 1;

  struct Sequence {
    std::uint32_t step = 0;
    unsigned extremes = 0;  ///< steps, one after the other, that were no usual multiple
  };

  /// Whether the next time is that of another sequence, which then is the current one.
  bool is_elsewhere(ArithmeticDecoder& decoder) {
    Sequence& sequence = sequences_[current_];
    if (sequence.step == 0) {
      constexpr unsigned kFirstFarAway = 2;
      const unsigned kind = decoder.symbol(same_step_);
      if (kind == 1) sequence = {numbers_.correction(decoder, 0), 0};
      return kind >= kFirstFarAway && is_far_away(decoder, kind - kFirstFarAway);
    }
    const unsigned multiple = decoder.symbol(multiple_);
    if (multiple >= kFarAway) return is_far_away(decoder, multiple - kFarAway);
    if (multiple != kSame) take_step(decoder, sequence, multiple);
    return false;
  }

  /// So many sequences further, or a new sequence if that is 0.
  bool is_far_away(ArithmeticDecoder& decoder, unsigned further) {
    current_ = (current_ + further) % sequences_.size();
    if (further > 0) return true;
    current_ = newest_ = (newest_ + 1) % sequences_.size();
    sequences_[current_] = {};
    numbers_.correction(decoder, 8);  // the upper half of the time
    decoder.bits(32);
    return false;
  }

  void take_step(ArithmeticDecoder& decoder, Sequence& sequence, unsigned multiple) {
    if (multiple == 1) {
      numbers_.correction(decoder, 1);
      sequence.extremes = 0;
    } else if (multiple == 0) {
      take_extreme(sequence, numbers_.correction(decoder, 7));
    } else if (multiple < kMostMultiple) {
      numbers_.correction(decoder, multiple < 10 ? 2 : 3);
    } else if (multiple == kMostMultiple) {
      take_extreme(sequence, numbers_.number(decoder, kMostMultiple * sequence.step, 4));
    } else if (multiple < kLeastMultiple) {
      numbers_.correction(decoder, 5);
    } else {
      take_extreme(sequence, numbers_.number(decoder, -10U * sequence.step, 6));
    }
  }

  static void take_extreme(Sequence& sequence, std::uint32_t step) {
    constexpr unsigned kMostExtremes = 3;
    if (++sequence.extremes > kMostExtremes) sequence = {step, 0};
  }

  SymbolModel same_step_{6};
  SymbolModel multiple_{kFarAway + 4};
  IntegerDecoder numbers_{32, 9};
  std::array<Sequence, 4> sequences_{};
  std::size_t current_ = 0;
  std::size_t newest_ = 0;
};

/// Formats 0 to 3: the first point as it is, then all attributes of a point one after the other.
class PointwiseDecoder : public ChunkDecoder {
 public:
  explicit PointwiseDecoder(const LazRecordLayout& layout)
      : layout_(layout), extra_(layout.extra_bytes, SymbolModel(256)) {}

  bool start(Bytes bytes, std::uint64_t count) override {
    const std::size_t size = layout_.record_size();
    if (bytes.size() < size) return false;
    is_first_ = true;
    is_alone_ = count == 1;
    x_ = whole_at<std::uint32_t>(bytes.data());
    y_ = whole_at<std::uint32_t>(bytes.data() + 4);
    returns_ = bytes[kReturnsAt];
    class_ = bytes[kFlagsAt];
    user_data_ = bytes[kUserDataAt];
    source_ = whole_at<std::uint16_t>(bytes.data() + kSourceAt);
    reset_models();
    decoder_.start(bytes.subspan(size));
    return true;
  }

  bool read(char* records, std::size_t count) override {
    for (std::size_t i = 0; i < count; ++i) {
      if (!is_first_) unpack_next();
      is_first_ = false;
      char* const record = records + i * kUnpackedSize;
      put(record, x_, 4);
      put(record + 4, y_, 4);
      put(record + kReturnsAt, returns_ | class_ << 8U, 2);
      put(record + kSourceAt, source_, 2);
    }
    return is_alone_ || !decoder_.is_broken();
  }

 private:
  void reset_models() {
    changes_.reset();
    reset(returns_models_);
    reset(class_models_);
    reset(user_data_models_);
    reset(scan_angles_);
    intensities_.reset();
    sources_.reset();
    places_.reset();
    heights_.reset();
    times_.reset();
    colour_changes_.reset();
    reset(colours_);
    reset(extra_);
  }

  void unpack_next() {
    ArithmeticDecoder& decoder = decoder_;
    const unsigned changes = decoder.symbol(changes_);
    if ((changes & 32U) != 0) returns_ = decoder.symbol(returns_models_[returns_]);
    const unsigned context = kReturnContext[returns_ >> 3U & 7U][returns_ & 7U];
    if ((changes & 16U) != 0) intensities_.correction(decoder, std::min(context, 3U));
    if ((changes & 8U) != 0) class_ = decoder.symbol(class_models_[class_]);
    if ((changes & 4U) != 0) decoder.symbol(scan_angles_[returns_ >> 6U & 1U]);
    if ((changes & 2U) != 0) user_data_ = decoder.symbol(user_data_models_[user_data_]);
    if ((changes & 1U) != 0) source_ = sources_.number(decoder, source_, 0);
    const bool is_single = (returns_ >> 3U & 7U) == 1;
    places_.next(decoder, context, is_single, x_, y_);
    heights_.correction(decoder, places_.context_of_height(is_single));
    if (layout_.has_time) times_.skip(decoder);
    if (layout_.has_colour) skip_colour();
    for (SymbolModel& model : extra_) decoder.symbol(model);
  }

  /// The low and the high byte of red, green and blue; no green and blue where they are as red.
  void skip_colour() {
    const unsigned changes = decoder_.symbol(colour_changes_);
    const bool is_grey = (changes & 64U) == 0;
    for (const unsigned byte : {0U, 1U, 2U, 4U, 3U, 5U}) {
      if ((changes >> byte & 1U) == 0 || (byte > 1 && is_grey)) continue;
      decoder_.symbol(colours_[byte]);
    }
  }

  LazRecordLayout layout_;
  ArithmeticDecoder decoder_;
  bool is_first_ = true;
  bool is_alone_ = false;  ///< Such a chunk need not have more than its point.
  std::uint32_t x_ = 0;    ///< of the last point, as the next ones are
  std::uint32_t y_ = 0;
  unsigned returns_ = 0;  ///< and scan direction and edge of flight line: the byte
  unsigned class_ = 0;    ///< and flags: the byte
  unsigned user_data_ = 0;
  std::uint32_t source_ = 0;
  SymbolModel changes_{64};
  std::vector<SymbolModel> returns_models_{256, SymbolModel(256)};  ///< by the last byte, as the next two
  std::vector<SymbolModel> class_models_{256, SymbolModel(256)};
  std::vector<SymbolModel> user_data_models_{256, SymbolModel(256)};
  std::vector<SymbolModel> scan_angles_{2, SymbolModel(256)};  ///< by the scan direction
  IntegerDecoder intensities_{16, 4};
  IntegerDecoder sources_{16, 1};
  PlaceDecoder places_{16};
  IntegerDecoder heights_{32, 20};
  TimeSkipper times_;
  SymbolModel colour_changes_{128};
  std::vector<SymbolModel> colours_{6, SymbolModel(256)};
  std::vector<SymbolModel> extra_;
};

/// Formats 6 to 8: the first point as it is; then layer by layer the attributes of all the others, each layer
/// with its length. A layer without bytes says that the attribute is the same all over the chunk.
class LayeredDecoder : public ChunkDecoder {
 public:
  explicit LayeredDecoder(const LazRecordLayout& layout) : layout_(layout) {}

  bool start(Bytes bytes, std::uint64_t count) override {
    const std::size_t record_size = layout_.record_size();
    const std::size_t layers =
        kLayerCount + (layout_.has_colour ? 1 : 0) + (layout_.has_infrared ? 1 : 0) + layout_.extra_bytes;
    const std::size_t fixed_size = record_size + 4 + 4 * layers;
    if (bytes.size() < fixed_size || whole_at<std::uint32_t>(&bytes[record_size]) < count) return false;
    is_first_ = true;
    is_alone_ = count == 1;
    for (Channel& channel : channels_) channel.is_used = false;
    const unsigned flags = bytes[kFlagsAt];
    channel_ = flags >> 4U & 3U;
    const unsigned returns = bytes[kReturnsAt];
    begin_channel({whole_at<std::uint32_t>(bytes.data()), whole_at<std::uint32_t>(&bytes[4]), returns & 15U,
                   returns >> 4U, (flags & 15U) | (flags >> 6U) << 4U, bytes[kClassAt],
                   whole_at<std::uint16_t>(&bytes[kSourceAt6])});
    Bytes sizes = bytes.subspan(record_size + 4);
    Bytes rest = bytes.subspan(fixed_size);
    for (std::size_t layer = 0; layer < kLayerCount; ++layer) {
      const std::size_t size = whole_at<std::uint32_t>(&sizes[4 * layer]);
      if (size > rest.size()) return false;
      layers_[layer].start(rest.first(size));
      has_layer_[layer] = size > 0;
      rest = rest.subspan(size);
    }
    has_layer_[kSourceLayer] &= layout_.wants_source;
    return true;
  }

  bool read(char* records, std::size_t count) override {
    for (std::size_t i = 0; i < count; ++i) {
      if (!is_first_) unpack_next();
      is_first_ = false;
      const LastPoint& last = channels_[channel_].last;
      char* const record = records + i * kUnpackedSize;
      put(record, last.x, 4);
      put(record + 4, last.y, 4);
      const std::uint32_t flags =
          (last.flags & 15U) | static_cast<std::uint32_t>(channel_) << 4U | (last.flags >> 4U) << 6U;
      put(record + kReturnsAt, last.number | last.returns << 4U | flags << 8U | last.classification << 16U,
          4);
      put(record + kSourceAt6, last.source, 2);
    }
    return is_alone_ || !is_broken();
  }

 private:
  /// In the order of the file. Behind them are those of colour, infrared and extra bytes.
  enum Layer : std::size_t {
    kPlaceLayer,  ///< with scanner channel and returns, and what of the other layers changes
    kHeightLayer,
    kClassLayer,
    kFlagsLayer,
    kIntensityLayer,
    kScanAngleLayer,
    kUserDataLayer,
    kSourceLayer,
    kTimeLayer,
    kLayerCount
  };

  struct LastPoint {
    std::uint32_t x = 0;
    std::uint32_t y = 0;
    unsigned number = 0;  ///< of the return
    unsigned returns = 0;
    unsigned flags = 0;  ///< four of the class, scan direction, edge of flight line
    unsigned classification = 0;
    std::uint32_t source = 0;
    bool has_new_time = false;  ///< other than the point before it

    /// 1 for a first return, 2 for a last one, 3 for a single one, else 0.
    unsigned kind() const { return (number == 1 ? 1U : 0U) + (number >= returns ? 2U : 0U); }
  };

  /// Each of the four scanner channels predicts its points from its own.
  struct Channel {
    bool is_used = false;  ///< in this chunk
    LastPoint last;
    std::vector<SymbolModel> changes{8, SymbolModel(128)};
    SymbolModel next_channel{3};
    std::vector<SymbolModel> returns{16, SymbolModel(16)};
    std::vector<SymbolModel> numbers{16, SymbolModel(16)};
    SymbolModel number_steps{13};
    PlaceDecoder places{12};
    std::vector<SymbolModel> classes{64, SymbolModel(256)};
    std::vector<SymbolModel> flags{64, SymbolModel(64)};
    IntegerDecoder sources{16, 1};
  };

  /// Of the channel `channel_`, where `last` is the last point of any channel.
  void begin_channel(const LastPoint& last) {
    Channel& channel = channels_[channel_];
    channel.is_used = true;
    channel.last = last;
    reset(channel.changes);
    channel.next_channel.reset();
    reset(channel.returns);
    reset(channel.numbers);
    channel.number_steps.reset();
    channel.places.reset();
    reset(channel.classes);
    reset(channel.flags);
    channel.sources.reset();
  }

  void unpack_next() {
    ArithmeticDecoder& decoder = layers_[kPlaceLayer];
    const unsigned changes = change_channel(decoder);
    Channel& channel = channels_[channel_];
    LastPoint& last = channel.last;
    const bool has_new_time = (changes & 16U) != 0;
    const unsigned number_before = last.number;
    if ((changes & 4U) != 0) last.returns = decoder.symbol(channel.returns[last.returns]);
    switch (changes & 3U) {
      case 0:
        break;
      case 1:
        last.number = (number_before + 1) % 16;
        break;
      case 2:
        last.number = (number_before + 15) % 16;
        break;
      default:
        last.number = has_new_time ? decoder.symbol(channel.numbers[number_before])
                                   : (number_before + decoder.symbol(channel.number_steps) + 2) % 16;
    }
    const std::size_t context = kReturnContext6[last.returns][last.number] * 2U + (has_new_time ? 1U : 0U);
    channel.places.next(decoder, context, last.returns == 1, last.x, last.y);
    if (has_layer_[kClassLayer]) {
      const unsigned is_single = last.kind() == 3 ? 1 : 0;
      last.classification =
          layers_[kClassLayer].symbol(channel.classes[(last.classification % 32) * 2 + is_single]);
    }
    if (has_layer_[kFlagsLayer]) last.flags = layers_[kFlagsLayer].symbol(channel.flags[last.flags]);
    if (has_layer_[kSourceLayer] && (changes & 32U) != 0) {
      last.source = channel.sources.number(layers_[kSourceLayer], last.source, 0);
    }
    last.has_new_time = has_new_time;
  }

  /// Makes the channel of the next point the current one. Returns which of its attributes change.
  unsigned change_channel(ArithmeticDecoder& decoder) {
    Channel& before = channels_[channel_];
    const unsigned context = before.last.kind() + (before.last.has_new_time ? 4 : 0);
    const unsigned changes = decoder.symbol(before.changes[context]);
    if ((changes & 64U) == 0) return changes;
    channel_ = (channel_ + decoder.symbol(before.next_channel) + 1) % channels_.size();
    if (!channels_[channel_].is_used) begin_channel(before.last);
    return changes;
  }

  bool is_broken() const {
    const auto is_broken = [&](Layer layer) { return has_layer_[layer] && layers_[layer].is_broken(); };
    return layers_[kPlaceLayer].is_broken() || is_broken(kClassLayer) || is_broken(kFlagsLayer) ||
           is_broken(kSourceLayer);
  }

  LazRecordLayout layout_;
  bool is_first_ = true;
  bool is_alone_ = false;  ///< Such a chunk need not have more than its point.
  std::size_t channel_ = 0;
  std::array<Channel, 4> channels_;
  std::array<ArithmeticDecoder, kLayerCount> layers_;
  std::array<bool, kLayerCount> has_layer_{};
};

}  // namespace

std::size_t LazRecordLayout::record_size() const {
  return (is_layered ? kPoint14Size : kPoint10Size + (has_time ? kTimeSize : 0)) +
         (has_colour ? kColourSize : 0) + (has_infrared ? kInfraredSize : 0) + extra_bytes;
}

std::unique_ptr<ChunkDecoder> make_chunk_decoder(const LazRecordLayout& layout) {
  if (layout.is_layered) return std::make_unique<LayeredDecoder>(layout);
  return std::make_unique<PointwiseDecoder>(layout);
}

}  // namespace polylidar::tool::point_files
