// What polygons are when they are read back: formats drop, cut or transform what they have no place for.
#pragma once

#include <gdal.h>

#include <optional>
#include <set>
#include <string>

#include "polylidar/geometry.hpp"
#include "tool/gdal/gdal_data.hpp"

namespace polylidar::tool {

/// What can be compared of a data set before and after it is written.
struct LayerContent {
  std::optional<Box> bounds;                    ///< of all shapes; nothing where all are empty
  std::optional<std::set<std::string>> labels;  ///< of features with a shape; nothing where these are no text
  SpatialSystem system;                         ///< null: none
};

/// Reads all features.
LayerContent content_of(GDALDatasetH dataset);

/// One of the labels that `written` has not as they are in `source`; nothing where all came through, or where
/// they cannot be compared.
std::optional<std::string> changed_label(const LayerContent& source, const LayerContent& written);

/// The name of the coordinate system that `written` is in where that is not `system`, in which `source` is,
/// and the coordinates are others.
std::optional<std::string> other_system(const LayerContent& source, OGRSpatialReferenceH system,
                                        const LayerContent& written);

}  // namespace polylidar::tool
