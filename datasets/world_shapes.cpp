#include "datasets/world_shapes.hpp"

#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

#include "datasets/sha256.hpp"
#include "datasets/shapes.hpp"

namespace hullbench {

/// datasets/shapes/world/manifest.json, put into the program when it is built, so that names are known
/// without the files.
extern const std::string_view kWorldManifestJson;

namespace {

using polylidar::MultiPolygon;

/// The shapes of one file, read once.
class ShapeFile {
 public:
  ShapeFile(std::filesystem::path path, std::string sha256, std::size_t count)
      : path_(std::move(path)), sha256_(std::move(sha256)), count_(count) {}

  const MultiPolygon& shape(std::size_t index) {
    const std::lock_guard lock(mutex_);
    if (index >= count_) {
      throw std::invalid_argument("there are only " + std::to_string(count_) + " shapes of this kind");
    }
    if (shapes_.empty()) read();
    return shapes_[index];
  }

 private:
  void read() {
    if (const std::string found = sha256_file(path_); found != sha256_) {
      throw std::runtime_error(path_.string() + " has SHA-256 " + found + " but the manifest says " +
                               sha256_ + "; restore the file, or build again if the change was meant");
    }
    std::vector<MultiPolygon> shapes = read_geojson_features(path_);
    if (shapes.size() != count_) {
      throw std::runtime_error(path_.string() + " has " + std::to_string(shapes.size()) +
                               " shapes but the manifest says " + std::to_string(count_));
    }
    shapes_ = std::move(shapes);
  }

  std::mutex mutex_;
  std::filesystem::path path_;
  std::string sha256_;
  std::size_t count_;
  std::vector<MultiPolygon> shapes_;  ///< empty until they are read
};

}  // namespace

std::vector<ShapeFamily> world_families() {
  std::vector<ShapeFamily> families;
  const nlohmann::json manifest = nlohmann::json::parse(kWorldManifestJson);
  for (const nlohmann::json& set : manifest.at("sets")) {
    const auto count = set.at("count").get<std::size_t>();
    const auto file =
        std::make_shared<ShapeFile>(default_data_directory() / "world" / set.at("file").get<std::string>(),
                                    set.at("sha256").get<std::string>(), count);
    families.push_back({.name = set.at("name").get<std::string>(),
                        .title = set.at("title").get<std::string>(),
                        .source = set.at("source").get<std::string>(),
                        .licence = set.at("licence").get<std::string>(),
                        .count = count,
                        .make = [file](std::size_t index) { return file->shape(index); }});
  }
  return families;
}

}  // namespace hullbench
