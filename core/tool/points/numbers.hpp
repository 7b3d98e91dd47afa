// Numbers in text and in binary.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "tool/points/block_reader.hpp"

namespace polylidar::tool::point_files {

/// Whether the whole of `text` is a number, be it one that a coordinate cannot be (nan, inf, 1e999).
bool is_number(std::string_view text);

/// The number that the whole of `text` is, at most one sign in front. Throws through `reader`, with its line,
/// when it is none, is not finite or too large for a double.
double parse_coordinate(std::string_view text, const BlockReader& reader);

/// The whole number, 0 or more, that the whole of `text` is.
std::optional<std::uint64_t> parse_count(std::string_view text);

/// The next word of `text`, between blanks, which is taken off it; empty when there is none.
std::string_view take_word(std::string_view& text);
std::string_view trimmed(std::string_view text);

/// The shortest decimal without an exponent that is read as `value` again, such as 100000 and 0.0001: a label
/// that is a number, as text has it.
std::string plain_decimal(double value);

/// `text` between quotes for a message: cut when it is long, with '?' for what cannot be shown: controls
/// and what is no UTF-8.
std::string in_quotes(std::string_view text);

/// A number's type in a binary file.
struct Scalar {
  enum class Kind { kSigned, kUnsigned, kFloat };
  Kind kind = Kind::kFloat;
  std::size_t size = 8;  ///< bytes: 1, 2, 4 or 8; 4 or 8 for kFloat
  bool big_endian = false;
};

/// The number in the `type.size` bytes at `bytes`; whole numbers beyond 2^53 are rounded.
double load(const char* bytes, const Scalar& type);

}  // namespace polylidar::tool::point_files
