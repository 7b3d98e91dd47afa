// Labels of groups, numbered.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>

#include "tool/points/point_file.hpp"

namespace polylidar::tool::point_files {

/// Gives every label a number, the first one 0.
class Labels {
 public:
  std::uint32_t index_of(std::string_view label);
  /// Puts the labels into `file`, sorted, and numbers its groups accordingly.
  void finish(PointFile& file) const;

 private:
  struct Hash {
    // NOLINTNEXTLINE(readability-identifier-naming): the name that the standard looks for
    using is_transparent = void;
    std::size_t operator()(std::string_view text) const { return std::hash<std::string_view>()(text); }
  };

  std::unordered_map<std::string, std::uint32_t, Hash, std::equal_to<>> numbers_;
};

}  // namespace polylidar::tool::point_files
