#include "datasets/towns.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "datasets/json_file.hpp"
#include "datasets/sha256.hpp"
#include "datasets/shapes.hpp"

namespace hullbench::towns {
namespace {

using nlohmann::json;
using polylidar::Point;

constexpr const char* kSha256 = "240a3b56a4a56b49c1936a02991c5a9d9219e3a37341e3e16119f9f652f5416a";

/// A flat array x, y, x, y ...
std::vector<Point> points_of(const json& numbers) {
  std::vector<Point> points;
  for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) {
    points.push_back({numbers[i].get<double>(), numbers[i + 1].get<double>()});
  }
  return points;
}

}  // namespace

const std::vector<Country>& countries() {
  static const std::vector<Country> all = {
      {"towns-am", "Towns of Armenia"},     {"towns-ao", "Towns of Angola"},
      {"towns-ar", "Towns of Argentina"},   {"towns-at", "Towns of Austria"},
      {"towns-au", "Towns of Australia"},   {"towns-be", "Towns of Belgium"},
      {"towns-ch", "Towns of Switzerland"}, {"towns-ci", "Towns of Côte d'Ivoire"},
      {"towns-cn", "Towns of China"},       {"towns-co", "Towns of Colombia"},
      {"towns-cz", "Towns of Czechia"},     {"towns-ec", "Towns of Ecuador"},
      {"towns-fi", "Towns of Finland"},     {"towns-hn", "Towns of Honduras"},
      {"towns-hu", "Towns of Hungary"},     {"towns-il", "Towns of Israel"},
      {"towns-ir", "Towns of Iran"},        {"towns-ma", "Towns of Morocco"},
      {"towns-mm", "Towns of Myanmar"},     {"towns-ng", "Towns of Nigeria"},
      {"towns-nl", "Towns of Netherlands"}, {"towns-pa", "Towns of Panama"},
      {"towns-pe", "Towns of Peru"},        {"towns-pk", "Towns of Pakistan"},
      {"towns-pl", "Towns of Poland"},      {"towns-pt", "Towns of Portugal"},
      {"towns-ro", "Towns of Romania"},     {"towns-rs", "Towns of Serbia"},
      {"towns-se", "Towns of Sweden"},      {"towns-sk", "Towns of Slovakia"},
      {"towns-th", "Towns of Thailand"},    {"towns-tr", "Towns of Turkey"},
      {"towns-ua", "Towns of Ukraine"},     {"towns-vn", "Towns of Vietnam"},
      {"towns-za", "Towns of South Africa"}};
  return all;
}

const Country* find_country(const std::string& name) {
  const auto found =
      std::ranges::find_if(countries(), [&](const Country& country) { return country.name == name; });
  return found == countries().end() ? nullptr : &*found;
}

Input read_input(const Country& country, const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "towns.geojson";
  if (sha256_file(path) != kSha256) {
    throw std::runtime_error(path.string() + " is not the file that this program was made for; restore it");
  }
  const json document = read_json_file(path);
  const json& feature = document.at("features").at(static_cast<std::size_t>(&country - countries().data()));
  return {points_of(feature.at("properties").at("towns")), parse_geojson(feature)};
}

}  // namespace hullbench::towns
