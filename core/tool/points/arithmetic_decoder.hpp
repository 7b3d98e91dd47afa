// The entropy coder of LAZ files: adaptive arithmetic coding, and numbers that are coded as corrections.
//
// Sources of the format: A. Said, "Introduction to Arithmetic Coding - Theory and Practice", HP Laboratories
// report HPL-2004-76, 2004; M. Isenburg, "LASzip: lossless compression of lidar data", Photogrammetric
// Engineering and Remote Sensing 79(2), 2013; ASPRS, "LAZ Specification" 1.4.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace polylidar::tool::point_files {

/// How often each of up to 2^10 symbols came so far, as the encoder counted them too. Takes memory once it is
/// used.
class SymbolModel {
 public:
  explicit SymbolModel(unsigned symbols) : symbols_(symbols) {}

  /// All symbols are as likely again.
  void reset() { total_ = until_refresh_ = 0; }

 private:
  friend class ArithmeticDecoder;

  static constexpr unsigned kShift = 15;  ///< starts are in units of 2^-15

  void begin();
  /// Brings the starts up to date with the counts; every so many symbols, as it takes long.
  void refresh();
  void find_starts();

  unsigned symbols_;
  std::uint32_t total_ = 0;          ///< of all counts at the last refresh; 0: nothing is there yet
  std::uint32_t cycle_ = 0;          ///< symbols from one refresh to the next
  std::uint32_t until_refresh_ = 0;  ///< symbols left; 0: due before the next symbol
  unsigned cell_shift_ = 0;
  std::vector<std::uint16_t> starts_;  ///< symbol -> start of its interval in [0, 2^15), increasing
  std::vector<std::uint16_t> counts_;  ///< symbol -> how often it came, at least 1
  /// Cell of 2^cell_shift_ units -> the last symbol that starts before the cell; one more for the end, and
  /// one as the last interval reaches up to 63 units, which is less than a cell, beyond 2^15.
  std::vector<std::uint16_t> cells_;
};

/// The same for one bit.
class BitModel {
 public:
  void reset() { *this = BitModel(); }

 private:
  friend class ArithmeticDecoder;

  static constexpr unsigned kShift = 13;

  void refresh();

  std::uint32_t zeros_ = 1;
  std::uint32_t total_ = 2;
  std::uint32_t start_of_one_ = 1U << (kShift - 1);  ///< in units of 2^-13
  std::uint32_t cycle_ = 4;
  std::uint32_t until_refresh_ = 4;
};

/// Takes symbols out of bytes. At their end, and where no encoder can have written them, is_broken() becomes
/// true, and what comes from then on means nothing; it is always in range.
class ArithmeticDecoder {
 public:
  /// `bytes` must stay as they are while symbols are taken.
  void start(std::span<const unsigned char> bytes);

  unsigned symbol(SymbolModel& model) {
    if (model.until_refresh_ == 0) model.refresh();
    --model.until_refresh_;
    const std::uint32_t unit = length_ >> SymbolModel::kShift;
    const std::uint32_t place = value_ / unit;
    const std::uint16_t* const starts = model.starts_.data();
    const std::uint16_t* const cell = model.cells_.data() + (place >> model.cell_shift_);
    unsigned found = cell[0];
    for (unsigned behind = cell[1] + 1U; behind > found + 1;) {
      const unsigned middle = (found + behind) / 2;
      (starts[middle] > place ? behind : found) = middle;
    }
    const std::uint32_t start = starts[found] * unit;
    const std::uint32_t end = found + 1 == model.symbols_ ? length_ : starts[found + 1] * unit;
    ++model.counts_[found];
    narrow(start, end - start);
    return found;
  }

  unsigned bit(BitModel& model) {
    const std::uint32_t start_of_one = model.start_of_one_ * (length_ >> BitModel::kShift);
    const bool is_one = value_ >= start_of_one;
    if (is_one) {
      narrow(start_of_one, length_ - start_of_one);
    } else {
      ++model.zeros_;
      narrow(0, start_of_one);
    }
    if (--model.until_refresh_ == 0) model.refresh();
    return is_one ? 1 : 0;
  }

  /// 1 to 32 bits that are as likely to be 0 as 1.
  std::uint32_t bits(unsigned count) {
    constexpr unsigned kMostAtOnce = 19;
    constexpr unsigned kHalf = 16;
    if (count <= kMostAtOnce) return few_bits(count);
    const std::uint32_t low = few_bits(kHalf);
    return few_bits(count - kHalf) << kHalf | low;
  }

  bool is_broken() const { return is_broken_; }

 private:
  static constexpr std::uint32_t kLeastLength = 1U << 24U;

  std::uint32_t few_bits(unsigned count) {
    const std::uint32_t unit = length_ >> count;
    const std::uint32_t found = value_ / unit;
    // The encoder leaves what is beyond the last whole unit unused. Going on from there would lose
    // value_ < length_, on which all places in tables rely.
    if (found >> count != 0) {
      break_off();
      return 0;
    }
    narrow(found * unit, unit);
    return found;
  }

  void narrow(std::uint32_t start, std::uint32_t length) {
    value_ -= start;
    length_ = length;
    while (length_ < kLeastLength) {
      value_ = value_ << 8U | next_byte();
      length_ <<= 8U;
    }
  }

  std::uint32_t next_byte() {
    if (next_ != end_) return *next_++;
    is_broken_ = true;
    return 0;
  }

  void break_off() {
    is_broken_ = true;
    next_ = end_;
    value_ = 0;
  }

  std::uint32_t value_ = 0;     ///< place of the code in the interval, less than length_
  std::uint32_t length_ = ~0U;  ///< of the interval, 2^24 or more between symbols
  const unsigned char* next_ = nullptr;
  const unsigned char* end_ = nullptr;
  bool is_broken_ = false;
};

/// Whole numbers, coded as how far a prediction misses them: in how many bits this fits, and which number of
/// so many bits.
class IntegerDecoder {
 public:
  /// Numbers of so many bits, 8 to 32. The number of bits of a correction has a model in each context.
  IntegerDecoder(unsigned bits, unsigned contexts);

  void reset();

  /// What is to be added to the prediction, modulo 2^32.
  std::uint32_t correction(ArithmeticDecoder& decoder, unsigned context) {
    width_ = decoder.symbol(widths_[context]);
    if (width_ == 0) return decoder.bit(zero_or_one_);
    if (width_ == 32) return 1U << 31U;
    std::uint32_t number = decoder.symbol(high_bits_[width_ - 1]);
    if (width_ > kHighBits) {
      const unsigned rest = width_ - kHighBits;
      number = number << rest | decoder.bits(rest);
    }
    // The upper half stands for 2^(width-1) + 1 to 2^width, the lower one for -(2^width - 1) to -2^(width-1).
    return number >> (width_ - 1) != 0 ? number + 1 : number - ((1U << width_) - 1);
  }

  std::uint32_t number(ArithmeticDecoder& decoder, std::uint32_t prediction, unsigned context) {
    return (prediction + correction(decoder, context)) & mask_;
  }

  /// Bits of the last correction: a measure of how well this point is predicted.
  unsigned width() const { return width_; }

 private:
  static constexpr unsigned kHighBits = 8;  ///< that have a model; those behind them are as they are

  std::uint32_t mask_;
  unsigned width_ = 0;
  std::vector<SymbolModel> widths_;     ///< context -> of the number of bits
  std::vector<SymbolModel> high_bits_;  ///< number of bits - 1 -> of the first ones of these
  BitModel zero_or_one_;
};

}  // namespace polylidar::tool::point_files
