// Ground-truth shapes on disk: a folder with a manifest.json and the GeoJSON files it lists.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "polylidar/geometry.hpp"

namespace hullbench {

/// The circular holes that a shape's variant with holes has cut out; see holes.hpp.
struct HoleParameters {
  std::size_t count = 0;   ///< >= 1
  double radius = 0;       ///< length unit of the shape, > 0
  std::uint64_t seed = 0;  ///< of the centres: part of the shape, not of a run
};

/// One shape as the manifest describes it.
struct ShapeInfo {
  std::string name;    ///< identifier, unique in the manifest: "ca"
  std::string title;   ///< as printed in tables: "California"
  std::string file;    ///< GeoJSON file in the manifest's folder
  std::string sha256;  ///< of the file, lower-case hex
  std::string source;  ///< who made the data
  std::string licence;
  double area = 0;                      ///< without holes, in squared units of the coordinates
  std::optional<HoleParameters> holes;  ///< none: the shape has no variant with holes
};

/// The folder with this project's own shapes: datasets/shapes in data_folder().
std::filesystem::path default_data_directory();

/// The shapes that `data_directory`/manifest.json lists, in its order. Throws std::runtime_error naming the
/// file and what to do when it is missing, not JSON, or an entry lacks a field, has a wrong type or repeats a
/// name.
std::vector<ShapeInfo> read_manifest(const std::filesystem::path& data_directory);

/// The polygons of a GeoJSON object, as read_geojson gives those of a file. Throws std::runtime_error naming
/// the ring, and nlohmann::json::exception when a member is missing or of another type.
polylidar::MultiPolygon parse_geojson(const nlohmann::json& object);

/// The polygons of a GeoJSON file (RFC 7946; coordinates in the plane): a Polygon or MultiPolygon, alone, in
/// a Feature or in the Features of a FeatureCollection. Rings lose the repeated last vertex and are turned:
/// shells counter-clockwise, holes clockwise; a third coordinate is dropped.
///
/// Throws std::runtime_error naming the file, the ring and what to do when the file is missing, not JSON, of
/// another geometry type or without a polygon, or when a ring is not closed, has a coordinate that is not a
/// finite number, fewer than 3 distinct vertices or no area. Whether rings cross is not looked at: scoring
/// refuses an invalid ground truth.
polylidar::MultiPolygon read_geojson(const std::filesystem::path& path);

/// The shapes of a FeatureCollection, one a feature, in the order of the file. Throws as read_geojson.
std::vector<polylidar::MultiPolygon> read_geojson_features(const std::filesystem::path& path);

/// The shape that `info` describes. Throws as read_geojson, and std::runtime_error when the file's SHA-256 is
/// not the manifest's.
polylidar::MultiPolygon load_shape(const std::filesystem::path& data_directory, const ShapeInfo& info);

}  // namespace hullbench
