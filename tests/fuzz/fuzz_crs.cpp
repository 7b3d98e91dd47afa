// Any bytes as what names a coordinate system: well-known text as in a .prj file, a name, or the keys of
// GeoTIFF as in a LAS file.
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>
#include <vector>

#include "tests/fuzz/memory_file.hpp"
#include "tool/points/crs.hpp"

namespace {

using namespace polylidar::tool;
using polylidar::fuzz::expect;

std::vector<std::uint16_t> keys_in(std::string_view bytes) {
  std::vector<std::uint16_t> keys(bytes.size() / 2);
  if (!keys.empty()) std::memcpy(keys.data(), bytes.data(), 2 * keys.size());
  return keys;
}

std::optional<Crs> found_in(std::string_view text, std::uint8_t choice) {
  if (choice % 3 == 1) return crs_of_name(text);
  if (choice % 3 == 2) return crs_of_geokeys(keys_in(text));
  std::optional<Crs> crs = crs_of_wkt(text);
  if (crs) expect((crs->epsg == 0) == (crs->wkt == text), "the text is kept where there is no number");
  return crs;
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): the name that libFuzzer calls
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1) return 0;
  const auto crs = found_in({reinterpret_cast<const char*>(data) + 1, size - 1}, data[0]);
  if (!crs) return 0;
  expect(crs->is_given && crs->epsg >= 0, "a system is found that is none");
  if (crs->epsg == 0) return 0;
  const std::optional<Crs> again = crs_of_name(crs->name());
  expect(again && again->epsg == crs->epsg, "a number is lost in its name");
  return 0;
}
