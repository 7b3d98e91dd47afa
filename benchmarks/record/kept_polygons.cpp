#include "benchmarks/record/kept_polygons.hpp"

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/files.hpp"
#include "datasets/sha256.hpp"

namespace hullbench::record {
namespace {

fs::path file_of(const fs::path& run, const std::string& sha256) {
  return run / kPolygonsFolder / (sha256 + ".wkb");
}

}  // namespace

std::string hash_of(std::span<const std::uint8_t> wkb) {
  return sha256_hex({reinterpret_cast<const char*>(wkb.data()), wkb.size()});
}

void keep_polygons(const fs::path& run, std::span<const std::uint8_t> wkb) {
  const fs::path file = file_of(run, hash_of(wkb));
  if (fs::exists(file)) return;
  fs::create_directories(file.parent_path());
  write_text_file(file, {wkb.begin(), wkb.end()});
}

std::optional<std::vector<std::uint8_t>> kept_polygons(const fs::path& run, const std::string& sha256) {
  const fs::path file = file_of(run, sha256);
  if (!fs::exists(file)) return std::nullopt;
  const std::string bytes = required_text(file);
  std::vector<std::uint8_t> wkb(bytes.begin(), bytes.end());
  if (hash_of(wkb) != sha256)
    throw ConfigurationError(file.string() + " was changed: its hash is not its name");
  return wkb;
}

}  // namespace hullbench::record
