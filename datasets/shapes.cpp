#include "datasets/shapes.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "datasets/data_folder.hpp"
#include "datasets/json_file.hpp"
#include "datasets/sha256.hpp"

namespace hullbench {

using nlohmann::json;

namespace {

HoleParameters parse_holes(const json& holes) {
  HoleParameters parameters;
  const bool whole = holes.at("count").is_number_unsigned() && holes.at("seed").is_number_unsigned();
  if (whole) {
    parameters.count = holes["count"].get<std::size_t>();
    parameters.seed = holes["seed"].get<std::uint64_t>();
    parameters.radius = holes.at("radius").get<double>();
  }
  if (parameters.count == 0 || !(parameters.radius > 0)) {
    throw std::runtime_error(
        "'holes' needs a whole 'count' of at least 1, a positive 'radius' and a whole 'seed'");
  }
  return parameters;
}

ShapeInfo parse_shape(const json& entry) {
  ShapeInfo info;
  entry.at("name").get_to(info.name);
  entry.at("title").get_to(info.title);
  entry.at("file").get_to(info.file);
  entry.at("sha256").get_to(info.sha256);
  entry.at("source").get_to(info.source);
  entry.at("licence").get_to(info.licence);
  entry.at("area").get_to(info.area);
  if (const auto holes = entry.find("holes"); holes != entry.end()) info.holes = parse_holes(*holes);
  return info;
}

}  // namespace

std::filesystem::path default_data_directory() {
  return data_folder() / "datasets" / "shapes";
}

std::vector<ShapeInfo> read_manifest(const std::filesystem::path& data_directory) {
  const std::filesystem::path path = data_directory / "manifest.json";
  const json manifest = read_json_file(path);
  std::vector<ShapeInfo> shapes;
  try {
    if (!manifest.at("shapes").is_array()) throw std::runtime_error("'shapes' is not an array");
    for (const json& entry : manifest["shapes"]) {
      ShapeInfo info = parse_shape(entry);
      const bool repeated = std::any_of(shapes.begin(), shapes.end(),
                                        [&](const ShapeInfo& shape) { return shape.name == info.name; });
      if (repeated) throw std::runtime_error("the name '" + info.name + "' stands twice");
      shapes.push_back(std::move(info));
    }
  } catch (const std::exception& error) {
    throw std::runtime_error(path.string() + " is not a shape manifest (" + error.what() +
                             "); correct it or restore it from the repository");
  }
  return shapes;
}

polylidar::MultiPolygon load_shape(const std::filesystem::path& data_directory, const ShapeInfo& info) {
  const std::filesystem::path path = data_directory / info.file;
  if (const std::string found = sha256_file(path); found != info.sha256) {
    throw std::runtime_error(path.string() + " has SHA-256 " + found + " but the manifest says " +
                             info.sha256 +
                             "; restore the file, or correct the manifest if the change was meant");
  }
  return read_geojson(path);
}

}  // namespace hullbench
