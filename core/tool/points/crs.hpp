// Where on Earth coordinates are: what files say of it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace polylidar::tool {

/// A coordinate reference system as far as it matters here. Nothing is known of it by default.
struct Crs {
  int epsg = 0;                    ///< its number in EPSG's register; 0: not known
  bool is_geographic = false;      ///< x and y are longitude and latitude, mostly in degrees
  bool is_given = false;           ///< something is said of it, be it not its number
  std::string wkt = {};            ///< well-known text of one without a number, where there is any
  bool is_not_in_degrees = false;  ///< longitude and latitude are in another unit, such as grads

  /// "EPSG:25832"; empty when the number is not known.
  std::string name() const;

  friend bool operator==(const Crs&, const Crs&) = default;
};

/// Of a number in EPSG's register. A number that the register of 2022 does not have counts as projected.
Crs crs_of_epsg(int number);

/// Of a name such as "EPSG:25832", "urn:ogc:def:crs:EPSG::25832" or "urn:ogc:def:crs:OGC:1.3:CRS84".
std::optional<Crs> crs_of_name(std::string_view name);

/// Of well-known text (OGC 01-009 and ISO 19162, also Esri's): the horizontal system in it. Its number is
/// known where the text has it, or by its name where that is one of UTM's (WGS 84, ETRS89, NAD83) or of these
/// three in degrees: Esri's .prj files have names only. Nothing where the text names no such system.
std::optional<Crs> crs_of_wkt(std::string_view text);

/// Of a GeoKeyDirectoryTag (OGC 19-008r4, 7.1.2): numbers of 16 bits, four a key. `texts` is what its keys of
/// text point into, the GeoAsciiParamsTag: the citation of a system without a number may be a name that
/// crs_of_wkt() knows.
std::optional<Crs> crs_of_geokeys(std::span<const std::uint16_t> keys, std::string_view texts = {});

}  // namespace polylidar::tool
