// Towns of countries: measured points with a true shape that somebody else has drawn, the country's outline.
//
// Towns are denser where more people live, and mountains and deserts have few. So part of a country may have
// no town near it: what is wrong then is the guess that the points fill the shape, which all methods share.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "polylidar/geometry.hpp"

namespace hullbench::towns {

/// A country of datasets/shapes/towns.geojson, which make_towns.py describes.
struct Country {
  std::string name;   ///< of the data set, with the country's ISO code: "towns-be"
  std::string title;  ///< as printed in tables: "Towns of Belgium"
};

/// All 35, by their codes.
const std::vector<Country>& countries();

/// The country of that name; null if there is none.
const Country* find_country(const std::string& name);

/// Kilometres on an equal-area projection.
struct Input {
  std::vector<polylidar::Point> points;  ///< the towns, each place once, by x and then y
  polylidar::MultiPolygon ground_truth;  ///< one polygon, simplified by 1.5 km
};

/// The towns of `country` and its outline, of towns.geojson in `folder`. Throws std::runtime_error naming the
/// file and what to do if it is missing or has been changed.
Input read_input(const Country& country, const std::filesystem::path& folder);

}  // namespace hullbench::towns
