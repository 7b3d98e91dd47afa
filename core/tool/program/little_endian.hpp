// Numbers as the bytes of files: the least significant one first, on machines of either byte order.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>

namespace polylidar::tool {

/// Appends the bytes of `value`.
template <class Whole>
void put(Whole value, std::string& to) {
  const auto bits = static_cast<std::make_unsigned_t<Whole>>(value);
  for (std::size_t byte = 0; byte < sizeof value; ++byte)
    to += static_cast<char>((bits >> (8 * byte)) & 0xFFU);
}

/// Appends the bytes of `value` as IEEE 754 has them.
inline void put(double value, std::string& to) {
  put(std::bit_cast<std::uint64_t>(value), to);
}

/// The number whose bytes, char or unsigned char, begin at `bytes`.
template <class Whole, class Byte>
Whole whole_at(const Byte* bytes) {
  static_assert(sizeof(Byte) == 1);
  if constexpr (std::endian::native == std::endian::little) {
    Whole value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
  } else {
    std::uint64_t bits = 0;
    for (std::size_t byte = sizeof(Whole); byte-- > 0;)
      bits = bits << 8U | static_cast<unsigned char>(bytes[byte]);
    return static_cast<Whole>(bits);
  }
}

/// The same of a double as IEEE 754 has it.
template <class Byte>
double double_at(const Byte* bytes) {
  return std::bit_cast<double>(whole_at<std::uint64_t>(bytes));
}

}  // namespace polylidar::tool
