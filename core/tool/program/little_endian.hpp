// Numbers as the bytes of files: the least significant one first, on machines of either byte order.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
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

}  // namespace polylidar::tool
