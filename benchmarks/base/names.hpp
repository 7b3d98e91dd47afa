// Names of other libraries that are written without their namespace everywhere here.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "polylidar/geometry.hpp"

namespace hullbench {

namespace fs = std::filesystem;
using nlohmann::json;
using polylidar::MultiPolygon;
using polylidar::Point;
using polylidar::Polygon;
using polylidar::Ring;

}  // namespace hullbench
