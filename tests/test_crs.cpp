// Coordinate systems as files name them, and degrees as metres.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "polylidar/geometry.hpp"
#include "tool/hull/degrees.hpp"
#include "tool/points/crs.hpp"
#include "tool/shapes/index_shape.hpp"

namespace polylidar::tool {
namespace {

TEST(CrsNames, TheirNumbers) {
  EXPECT_EQ(crs_of_name("EPSG:25832"), (Crs{25832, false, true}));
  EXPECT_EQ(crs_of_name("epsg:4326"), (Crs{4326, true, true}));
  EXPECT_EQ(crs_of_name("urn:ogc:def:crs:EPSG::25832"), (Crs{25832, false, true}));
  EXPECT_EQ(crs_of_name("urn:ogc:def:crs:EPSG:9.9:4258"), (Crs{4258, true, true}));
  EXPECT_EQ(crs_of_name("http://www.opengis.net/def/crs/EPSG/0/3857"), (Crs{3857, false, true}));
  EXPECT_EQ(crs_of_name("urn:ogc:def:crs:OGC:1.3:CRS84"), (Crs{4326, true, true}));
  EXPECT_EQ(crs_of_name("urn:ogc:def:crs,crs:EPSG::4326,crs:EPSG::5773"), (Crs{4326, true, true}));
  EXPECT_EQ(crs_of_name("urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::7837"), (Crs{25832, false, true}));
  EXPECT_EQ(crs_of_name("EPSG:25832+7837"), (Crs{25832, false, true}));
  for (const char* none :
       {"", "EPSG", "EPSG:", "EPSG:x", "EPSG:-3", "EPSG:99999999999", "25832", "ESRI:102100"}) {
    EXPECT_EQ(crs_of_name(none), std::nullopt) << none;
  }
}

TEST(CrsNumbers, OfDegreesAreThoseOfGeographicSystems) {
  // NAD83(2011), JGD2011, GDA2020, RGF93 v2b, CGCS2000, ETRS89 and WGS 84 in three dimensions, and the ends
  // of ranges.
  for (const int number :
       {6318, 6668, 7844, 9784, 4490, 4937, 4979, 4326, 4258, 4269, 3819, 3821, 4120,  4216,  9518, 6697,
        9707, 5498, 4218, 4327, 4329, 4339, 4383, 4921, 4999, 7915, 7931, 8948, 20033, 20040, 20041}) {
    EXPECT_TRUE(crs_of_epsg(number).is_geographic) << number;
  }
  // Gauss-Krueger and UTM zones, plate carrees, geocentric, vertical and compound systems, and numbers of
  // none.
  std::vector<int> others = {4647, 4559, 4087, 4088,  4978,  4936, 4328,  4340,   4922,
                             7916, 8947, 3857, 25832, 32632, 2056, 27700, 5514,   5555,
                             5773, 7405, 3818, 5000,  20042, 0,    -4326, 1000000};
  for (int number = 4491; number <= 4554; ++number) others.push_back(number);
  for (const int number : others) EXPECT_FALSE(crs_of_epsg(number).is_geographic) << number;
}

TEST(CrsText, TheHorizontalSystem) {
  EXPECT_EQ(crs_of_wkt(R"(GEOGCS["WGS 84",DATUM["d",SPHEROID["s",1,2]],AUTHORITY["EPSG","4326"]])"),
            (Crs{4326, true, true}));
  EXPECT_EQ(
      crs_of_wkt(R"(COMPD_CS["c",PROJCS["p",GEOGCS["g",AUTHORITY["EPSG","4258"]],AUTHORITY["EPSG","25832"]],)"
                 R"(VERT_CS["v",AUTHORITY["EPSG","7837"]],AUTHORITY["EPSG","5555"]])"),
      (Crs{25832, false, true}));
  EXPECT_EQ(crs_of_wkt(R"(PROJCRS["p",BASEGEOGCRS["b",ID["EPSG",4258]],CONVERSION["u",ID["EPSG",16032]],)"
                       R"(CS[Cartesian,2],ID["EPSG",25832]])"),
            (Crs{25832, false, true}));
  EXPECT_EQ(crs_of_wkt(R"(GEOGCRS["g",CS[ellipsoidal,2],ID["EPSG",4979]])"), (Crs{4979, true, true}));
  const char* const esris = R"(PROJCS["World_Mollweide",GEOGCS["GCS_WGS_1984"]])";
  EXPECT_EQ(crs_of_wkt(esris), (Crs{0, false, true, esris})) << "Esri's";
  const char* const inside =
      R"(PROJCS["p",GEOGCS["g",AUTHORITY["EPSG","4258"]],UNIT["m",1,AUTHORITY["EPSG","9001"]]])";
  EXPECT_EQ(crs_of_wkt(inside), (Crs{0, false, true, inside})) << "that of what is inside is not its own";
  EXPECT_EQ(crs_of_wkt(R"( GEOGCS [ "a [ , ] b" , AUTHORITY [ "EPSG" , "4269" ] ] )"),
            (Crs{4269, true, true}));
  for (const char* none : {"", "LOCAL_CS[\"x\"]", "]]]", "[[[[", "x,y\n1,2\n", "\"", "PROJCS"}) {
    EXPECT_EQ(crs_of_wkt(none), std::nullopt) << none;
  }
}

TEST(CrsText, KnownNamesHaveNumbers) {
  const auto projected = [](const std::string& name) {
    return crs_of_wkt("PROJCS[\"" + name + R"(",GEOGCS["GCS_WGS_1984"],UNIT["Meter",1.0]])")->epsg;
  };
  EXPECT_EQ(projected("WGS_1984_UTM_Zone_32N"), 32632);
  EXPECT_EQ(projected("WGS 84 / UTM zone 7S"), 32707);
  EXPECT_EQ(projected("ETRS_1989_UTM_Zone_33N"), 25833);
  EXPECT_EQ(projected("NAD83 / UTM zone 10N"), 26910);
  for (const char* other :
       {"WGS_1984_UTM_Zone_61N", "WGS_1984_UTM_Zone_0N", "WGS_1984_UTM_Zone_", "WGS_1984_UTM_Zone_N",
        "ETRS_1989_UTM_Zone_33S", "ETRS_1989_UTM_Zone_3N", "WGS_1984_World_Mercator", ""}) {
    EXPECT_EQ(projected(other), 0) << other;
  }
  EXPECT_EQ(
      crs_of_wkt(R"(PROJCS["NAD83 / UTM zone 10N",GEOGCS["x",UNIT["Degree",0.0174]],UNIT["Foot_US",0.3048]])")
          ->epsg,
      0);
  EXPECT_EQ(crs_of_wkt(R"(PROJCRS["NAD83 / UTM zone 10N",BASEGEOGCRS["x"],CS[Cartesian,2],)"
                       R"(AXIS["e",east,LENGTHUNIT["foot",0.3048]]])")
                ->epsg,
            0);
  EXPECT_EQ(crs_of_wkt(R"(GEOGCS["GCS_WGS_1984",DATUM["D_WGS_1984"]])"), (Crs{4326, true, true}));
  EXPECT_EQ(crs_of_wkt(R"(GEOGCS["GCS_North_American_1983"])"), (Crs{4269, true, true}));
  EXPECT_EQ(crs_of_wkt(R"(GEOGCS["GCS_Bessel"])"), (Crs{0, true, true, R"(GEOGCS["GCS_Bessel"])"}));
}

TEST(Grads, AreNoDegrees) {
  // NTF (Paris), the same with heights, Voirol 1879 (Paris) and ATF (Paris); Bern 1898 (Bern) is in degrees.
  for (const int number : {4807, 7400, 4821, 4901}) {
    EXPECT_TRUE(crs_of_epsg(number).is_geographic && crs_of_epsg(number).is_not_in_degrees) << number;
  }
  for (const int number : {4801, 4806, 4903, 4326, 27572}) {
    EXPECT_FALSE(crs_of_epsg(number).is_not_in_degrees) << number;
  }
  EXPECT_TRUE(crs_of_name("EPSG:4807")->is_not_in_degrees);
  const auto in_grads = [](const std::string& inside) {
    return crs_of_wkt(R"(GEOGCS["GCS_somewhere",DATUM["d"],)" + inside + "]")->is_not_in_degrees;
  };
  EXPECT_TRUE(in_grads(R"(UNIT["Grad",0.01570796326794897])"));
  EXPECT_TRUE(in_grads(R"(AXIS["lat",north,ANGLEUNIT["grad",0.0157]],AXIS["lon",east])"));
  EXPECT_TRUE(in_grads(R"(AUTHORITY["EPSG","4807"])"));
  EXPECT_TRUE(in_grads(R"(UNIT["radian",1])"));
  EXPECT_FALSE(in_grads(R"(UNIT["Degree",0.0174532925199433])"));
  EXPECT_FALSE(in_grads(R"(UNIT["degree",0.0174])"));
  EXPECT_FALSE(in_grads(R"(PRIMEM["Paris",2.5969213,ANGLEUNIT["grad",0.0157]],ANGLEUNIT["degree",0.01745])"));
  EXPECT_FALSE(in_grads(R"(AXIS["h",up,LENGTHUNIT["metre",1]])"));
  EXPECT_FALSE(
      crs_of_wkt(R"(PROJCS["p",GEOGCS["g",UNIT["Grad",0.0157]],UNIT["metre",1]])")->is_not_in_degrees);
  const auto keys = [](std::uint16_t system, std::uint16_t unit) {
    return crs_of_geokeys(
        std::vector<std::uint16_t>{1, 1, 0, 3, 1024, 0, 1, 2, 2048, 0, 1, system, 2054, 0, 1, unit});
  };
  EXPECT_EQ(keys(4275, 9102), (Crs{4275, true, true}));
  EXPECT_EQ(keys(4275, 9105), (Crs{4275, true, true, "", true}));
  EXPECT_EQ(keys(32767, 9105), (Crs{0, true, true, "", true}));
  EXPECT_TRUE(keys(4807, 0)->is_not_in_degrees);
}

TEST(GeoKeys, ACitationOfAKnownNameHasANumber) {
  const std::vector<std::uint16_t> keys = {1, 1, 0, 2, 1024, 0, 1, 1, 3073, 34737, 99, 2};
  EXPECT_EQ(crs_of_geokeys(keys, "x|PCS Name = NAD_1983_UTM_Zone_10N|"), (Crs{26910, false, true}))
      << "Esri's";
  EXPECT_EQ(crs_of_geokeys(keys, "x|State_Plane_somewhere|"), (Crs{0, false, true}));
  EXPECT_EQ(crs_of_geokeys(keys, "x"), (Crs{0, false, true}));
  EXPECT_EQ(crs_of_geokeys(keys), (Crs{0, false, true}));
}

constexpr double kRadians = std::numbers::pi / 180;

/// R^2 * (east - west) * (sin north - sin south)
double area_of_box(double west, double south, double east, double north) {
  constexpr double kRadius = 6371007.2;
  return kRadius * kRadius * (east - west) * kRadians *
         (std::sin(north * kRadians) - std::sin(south * kRadians));
}

TEST(Degrees, HaveTheAreasOfTheSphereAtAllLatitudes) {
  for (const auto& [south, north] : std::vector<std::pair<double, double>>{
           {-0.5, 0.5}, {0, 1}, {60, 61}, {-61, -60}, {40, 50}, {-5, 5}, {80, 90}, {50, 50 + 1e-5}}) {
    const Ring box = {{10, south}, {11, south}, {11, north}, {10, north}};
    const double area = area_of_box(10, south, 11, north);
    for (const double latitude : {(south + north) / 2, 45.0, 0.0}) {
      const std::vector<Point> metres = to_metres(box, latitude);
      EXPECT_NEAR(signed_area_on_sphere(metres, latitude), area, 1e-8 * area) << south << ' ' << latitude;
      EXPECT_NEAR(signed_area_on_sphere({metres.rbegin(), metres.rend()}, latitude), -area, 1e-8 * area);
    }
  }
  // Below the diagonal from the equator to 10 degrees: the integral of the sine.
  const double below = 6371007.2 * 6371007.2 * (1 - std::cos(10 * kRadians));
  const std::vector<Point> triangle = to_metres(std::vector<Point>{{20, 0}, {30, 0}, {30, 10}}, 45);
  EXPECT_NEAR(signed_area_on_sphere(triangle, 45), below, 1e-9 * below);
  // What lies between 10 and 10.0001 degrees, where a plane is good enough.
  const std::vector<Point> small = to_metres(std::vector<Point>{{7, 10}, {7.0001, 10}, {7, 10.0001}}, 10);
  EXPECT_NEAR(signed_area_on_sphere(small, 10), signed_area(small), 1e-5 * signed_area(small));
  EXPECT_EQ(signed_area_on_sphere({}, 10), 0);
}

TEST(Degrees, HaveAShapesAreaOnTheSphereWithoutItsHolesHoweverItsRingsRun) {
  const double area_of_shape = area_of_box(10, 40, 20, 50) - area_of_box(12, 42, 14, 44);
  const Ring shell = to_metres(Ring{{10, 40}, {20, 40}, {20, 50}, {10, 50}}, 45);
  const Ring hole = to_metres(Ring{{12, 42}, {14, 42}, {14, 44}, {12, 44}}, 45);
  const Ring clockwise = {hole.rbegin(), hole.rend()};
  EXPECT_NEAR(area(MultiPolygon{{shell, {hole}}}, 45.0), area_of_shape, 1e-9 * area_of_shape);
  EXPECT_NEAR(area(MultiPolygon{{shell, {clockwise}}}, 45.0), area_of_shape, 1e-9 * area_of_shape);
  EXPECT_EQ(area(MultiPolygon{{shell, {hole}}}, {}), polylidar::area({{shell, {hole}}}));
}

TEST(Degrees, AreMetresOnASphere) {
  const Crs degrees = crs_of_epsg(4326);
  const std::vector<Point> square = {{10, 50}, {11, 50}, {11, 51}, {10, 51}};
  ASSERT_EQ(middle_latitude(degrees, square), 50.5);
  const std::vector<Point> box = {{0, 60}, {2, 60}, {2, 61}, {0, 61}};
  const double degree = 6371007.2 * kRadians;
  EXPECT_NEAR(signed_area(to_metres(box, 60)), degree * degree, 1);
  EXPECT_EQ(middle_latitude(crs_of_epsg(25832), square), std::nullopt);
  EXPECT_EQ(middle_latitude(Crs(), square), std::nullopt);
  EXPECT_EQ(middle_latitude(degrees, {}), std::nullopt);
}

TEST(Degrees, AreGuessedOfPlacesFarFromTheOrigin) {
  const auto look = [](double west, double south, double east, double north) {
    return look_like_degrees({{west, south}, {east, north}});
  };
  EXPECT_TRUE(look(13.0884, 52.3383, 13.7611, 52.6755)) << "Berlin";
  EXPECT_TRUE(look(-124.7332, 24.5439, -66.9498, 49.3845)) << "the United States";
  EXPECT_TRUE(look(36.6645, -1.4448, 37.1049, -1.1606)) << "Nairobi";
  EXPECT_TRUE(look(-0.4903, 51.28676, -0.4902, 51.2868)) << "a garden";
  EXPECT_FALSE(look(0, 0, 1, 1));
  EXPECT_FALSE(look(0.1234567, 0.2, 0.9876543, 0.8)) << "a unit square";
  EXPECT_FALSE(look(-4.1234567, -3.7654321, 7.8901234, 2.3456789)) << "a room round a scanner";
  EXPECT_FALSE(look(2.1234567, 3.7654321, 7.8901234, 9.3456789)) << "a room beside its origin";
  EXPECT_FALSE(look(20.125, 30.25, 25.5, 34.875)) << "thousandths of a metre";
  EXPECT_FALSE(look(100, 50, 140, 80)) << "pixels";
  EXPECT_FALSE(look(13.0884, 52.3383, 13.0884, 52.3383)) << "a point";
  EXPECT_FALSE(look(181.12345, 52.3383, 181.7611, 52.6755));
  EXPECT_FALSE(look(500000.1234, 5600000.1234, 500010.1234, 5600010.1234));
  EXPECT_FALSE(look_like_degrees(bounding_box({})));
}

TEST(Degrees, ComeBackToTheLastBit) {
  const std::vector<Point> points = {{10.1, 50.3}, {11.7, 50.2}, {11.3, 51.9}, {10.2, 51.1}};
  const Polygon square = {points, {{points[0], points[1], points[2]}}};
  const std::vector<Point> metres = to_metres(points, 51);
  const MultiPolygon in_metres = {{metres, {{metres[0], metres[1], metres[2]}}}};
  EXPECT_EQ(to_degrees(in_metres, points, 51), MultiPolygon{square});
  const MultiPolygon of_others = to_degrees(in_metres, {}, 51);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(of_others[0].shell[i].x, points[i].x, 1e-12);
    EXPECT_NEAR(of_others[0].shell[i].y, points[i].y, 1e-12);
  }
}

}  // namespace
}  // namespace polylidar::tool
