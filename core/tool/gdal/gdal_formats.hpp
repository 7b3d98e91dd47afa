// What GDAL's OGR reads and writes: GeoPackage, Shapefile, FlatGeobuf, PostGIS and whatever else the
// installed GDAL has.
#pragma once

#include <string>

#include "tool/gdal/vector_formats.hpp"

namespace polylidar::tool {

/// GDAL, with all its drivers. Several threads may read at a time.
const VectorFormats& gdal_formats();

/// Its version, such as "3.6.2".
std::string gdal_version();

}  // namespace polylidar::tool
