// Words in capitals or small letters.
#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

namespace polylidar::tool {

/// With A to Z as small letters.
inline std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// With a to z as capitals.
inline std::string upper_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

/// Whether two texts differ in nothing but capitals and small letters.
inline bool equal_in_any_case(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char c, unsigned char d) { return std::tolower(c) == std::tolower(d); });
}

}  // namespace polylidar::tool
