#include "tool/points/numbers.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace polylidar::tool::point_files {
namespace {

constexpr std::string_view kBlanks = " \t\v\f\r";
constexpr std::size_t kLongestQuote = 40;

/// Reads the whole of `text` into `value`: std::errc() for a number, finite or not.
std::errc parse(std::string_view text, double& value) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size()) return std::errc::invalid_argument;
  if (error != std::errc::result_out_of_range) return error;
  // from_chars does not say whether a number is too large or too small, and one too small is as good as 0.
  value = std::strtod(std::string(text).c_str(), nullptr);
  return std::isfinite(value) ? std::errc() : error;
}

/// How many bytes the character at the beginning of `text` has; 0 for one that cannot be shown: a control, or
/// bytes that are no UTF-8 (RFC 3629, section 4).
std::size_t shown_bytes(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return first >= ' ' && first <= '~' ? 1 : 0;
  const std::size_t bytes = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < bytes) return 0;
  // Neither U+0080 to U+009F, which are controls, nor a longer form than needed, nor a half of a pair of
  // UTF-16, nor what is beyond U+10FFFF.
  const unsigned char lowest = first == 0xC2 || first == 0xE0 ? 0xA0 : first == 0xF0 ? 0x90 : 0x80;
  const unsigned char highest = first == 0xED ? 0x9F : first == 0xF4 ? 0x8F : 0xBF;
  if (byte(1) < lowest || byte(1) > highest) return 0;
  for (std::size_t i = 2; i < bytes; ++i) {
    if ((byte(i) & 0xC0U) != 0x80) return 0;
  }
  return bytes;
}

}  // namespace

bool is_number(std::string_view text) {
  double value = 0;
  return parse(text, value) != std::errc::invalid_argument;
}

double parse_coordinate(std::string_view text, const BlockReader& reader) {
  double value = 0;
  const std::errc error = parse(text, value);
  if (error == std::errc() && std::isfinite(value)) return value;
  if (text.empty()) reader.fail_here("a coordinate is missing; give the number or remove the point");
  if (error == std::errc()) {
    reader.fail_here("the coordinate " + in_quotes(text) + " is not finite; remove the point");
  }
  if (error == std::errc::result_out_of_range) {
    reader.fail_here("the coordinate " + in_quotes(text) + " is too large for a double; use a larger unit");
  }
  reader.fail_here(in_quotes(text) + " is not a number; write coordinates as 12.5 or -1e3" +
                   (text.find(',') == std::string_view::npos ? "" : ", with a point and no comma"));
}

std::optional<std::uint64_t> parse_count(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

std::string_view take_word(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(kBlanks));
  text.remove_prefix(word.size());
  return word;
}

std::string_view trimmed(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  return text.substr(0, text.find_last_not_of(kBlanks) + 1);
}

std::string plain_decimal(double value) {
  std::array<char, 512> digits{};  // the least double has some 340 of them
  const std::to_chars_result written =
      std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::fixed);
  return {digits.data(), written.ptr};
}

std::string in_quotes(std::string_view text) {
  std::string shown;
  while (!text.empty() && shown.size() < kLongestQuote) {
    const std::size_t bytes = shown_bytes(text);
    shown += bytes > 0 ? text.substr(0, bytes) : "?";
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return "'" + shown + (text.empty() ? "'" : "...'");
}

double load(const char* bytes, const Scalar& type) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < type.size; ++i) {
    const std::size_t place = type.big_endian ? type.size - 1 - i : i;
    bits |= std::uint64_t{static_cast<unsigned char>(bytes[i])} << (8 * place);
  }
  switch (type.kind) {
    case Scalar::Kind::kFloat:
      if (type.size == 8) return std::bit_cast<double>(bits);
      return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
    case Scalar::Kind::kSigned: {
      if (type.size == 0) return 0;
      const auto unused = static_cast<unsigned>(64 - 8 * type.size);
      return static_cast<double>(static_cast<std::int64_t>(bits << unused) >> unused);
    }
    case Scalar::Kind::kUnsigned:
      break;
  }
  return static_cast<double>(bits);
}

}  // namespace polylidar::tool::point_files
