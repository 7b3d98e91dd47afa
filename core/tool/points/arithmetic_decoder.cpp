#include "tool/points/arithmetic_decoder.hpp"

#include <algorithm>

namespace polylidar::tool::point_files {
namespace {

/// Refreshes come at once in the beginning, then ever more rarely.
std::uint32_t longer(std::uint32_t cycle, std::uint32_t longest) {
  return std::min(5 * cycle / 4, longest);
}

}  // namespace

void SymbolModel::begin() {
  unsigned cell_bits = 3;
  while (symbols_ > 1U << (cell_bits + 1)) ++cell_bits;
  cell_shift_ = kShift - cell_bits;
  starts_.resize(symbols_);
  counts_.assign(symbols_, 1);
  cells_.resize((std::size_t{1} << cell_bits) + 2);
  total_ = symbols_;
  cycle_ = (symbols_ + 6) / 2;
}

void SymbolModel::refresh() {
  constexpr std::uint32_t kMostTotal = 1U << kShift;
  if (total_ == 0) {
    begin();
  } else {
    total_ += cycle_;
    if (total_ > kMostTotal) {
      total_ = 0;
      for (std::uint16_t& count : counts_) {
        count = static_cast<std::uint16_t>((count + 1) / 2);
        total_ += count;
      }
    }
    cycle_ = longer(cycle_, (symbols_ + 6) * 8);
  }
  until_refresh_ = cycle_;
  find_starts();
}

void SymbolModel::find_starts() {
  const std::uint32_t scale = (1U << 31U) / total_;
  std::uint32_t before = 0;
  std::size_t cell = 0;
  cells_[0] = 0;
  for (unsigned s = 0; s < symbols_; ++s) {
    starts_[s] = static_cast<std::uint16_t>(scale * before >> (31 - kShift));
    before += counts_[s];
    while (cell < std::size_t{starts_[s]} >> cell_shift_) cells_[++cell] = static_cast<std::uint16_t>(s - 1);
  }
  std::fill(cells_.begin() + static_cast<std::ptrdiff_t>(cell) + 1, cells_.end(),
            static_cast<std::uint16_t>(symbols_ - 1));
}

void BitModel::refresh() {
  constexpr std::uint32_t kMostTotal = 1U << kShift;
  constexpr std::uint32_t kLongestCycle = 64;
  total_ += cycle_;
  if (total_ > kMostTotal) {
    total_ = (total_ + 1) / 2;
    zeros_ = (zeros_ + 1) / 2;
    if (zeros_ == total_) ++total_;
  }
  start_of_one_ = (1U << 31U) / total_ * zeros_ >> (31 - kShift);
  cycle_ = until_refresh_ = longer(cycle_, kLongestCycle);
}

void ArithmeticDecoder::start(std::span<const unsigned char> bytes) {
  next_ = bytes.data();
  end_ = bytes.data() + bytes.size();
  length_ = ~0U;
  is_broken_ = false;
  value_ = 0;
  for (int i = 0; i < 4; ++i) value_ = value_ << 8U | next_byte();
  if (value_ == length_) break_off();
}

IntegerDecoder::IntegerDecoder(unsigned bits, unsigned contexts)
    : mask_(~0U >> (32 - bits)), widths_(contexts, SymbolModel(bits + 1)) {
  // 32 bits are one number only.
  for (unsigned width = 1; width <= std::min(bits, 31U); ++width) {
    high_bits_.emplace_back(1U << std::min(width, kHighBits));
  }
}

void IntegerDecoder::reset() {
  for (SymbolModel& model : widths_) model.reset();
  for (SymbolModel& model : high_bits_) model.reset();
  zero_or_one_.reset();
  width_ = 0;
}

}  // namespace polylidar::tool::point_files
