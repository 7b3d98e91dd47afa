// The candidates as a page with pictures side by side, and as a table.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "benchmarks/choose/candidates.hpp"
#include "benchmarks/table/table.hpp"

namespace hullbench::choose {

/// Where the points are from.
struct PointSource {
  std::string name;             ///< of the file
  std::size_t total = 0;        ///< points in it
  std::size_t taken = 0;        ///< of the sample, which every method gets; `total`: there is none
  bool all_where_fast = false;  ///< methods that are fast enough get all points instead
  std::uint64_t seed = 0;       ///< of the sample
  polylidar::Box box;           ///< of all points, which is the frame of the pictures
  bool in_metres = false;       ///< they are longitudes and latitudes, and were taken as metres
  int draws = 0;                ///< of halves, for the stability
};

/// "points.csv has 30000 points; 20000 of them, drawn with seed 1, were taken."
std::string told_of(const PointSource& source);

/// A whole HTML page: a card for each candidate with its picture, numbers and commands, who agrees with whom,
/// and who is absent. It needs no network, no script and no other file, in light and dark. All pictures have
/// the same frame. `points` are those that were taken, of which at most PictureBook::kMostPoints are drawn.
std::string choice_page(const Candidates& candidates, std::span<const Point> points,
                        const PointSource& source);

/// The numbers of the cards, a row a candidate.
table::Document choice_table(const Candidates& candidates, const PointSource& source);

}  // namespace hullbench::choose
