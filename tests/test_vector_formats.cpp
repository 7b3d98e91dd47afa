// `polylidar` with GDAL, and what it says without: layers of points in, layers of polygons out.
#include <cpl_string.h>
#include <gdal.h>
#include <gtest/gtest.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <random>

#include "adapters/adapter.hpp"
#include "benchmarks/base/names.hpp"
#include "tests/complaint.hpp"
#include "tests/las_file.hpp"
#include "tests/point_file_texts.hpp"
#include "tests/program.hpp"
#include "tests/temporary_folder.hpp"
#ifdef HULLBENCH_HAS_POSTGRES
#include "adapters/private_postgres.hpp"
#endif

namespace hullbench::testing {
namespace {

/// Uniform in the square of side 100 without a disc, in metres of UTM.
Points utm_square_without_a_disc() {
  Points points;
  std::mt19937 random(11);
  while (points.size() < 4000) {
    const Point p = {static_cast<double>(random() % 1000000) / 1e4,
                     static_cast<double>(random() % 1000000) / 1e4};
    if (std::hypot(p.x - 50, p.y - 40) > 20) points.push_back({500000 + p.x, 5600000 + p.y});
  }
  return points;
}

/// What is written into a data set, by GDAL itself.
class NewData {
 public:
  NewData(const std::string& path, const char* driver)
      : data_(path.starts_with("PG:")
                  ? GDALOpenEx(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_UPDATE, nullptr, nullptr, nullptr)
                  : GDALCreate(GDALGetDriverByName(driver), path.c_str(), 0, 0, 0, GDT_Unknown, nullptr)) {
    if (data_ == nullptr) throw std::runtime_error("GDAL cannot make " + path);
  }
  ~NewData() { GDALClose(data_); }
  NewData(const NewData&) = delete;
  NewData& operator=(const NewData&) = delete;

  void execute(const char* sql) const {
    GDALDatasetReleaseResultSet(data_, GDALDatasetExecuteSQL(data_, sql, nullptr, nullptr));
  }

  /// A layer with the fields kind (text), number (whole) and value (real).
  OGRLayerH layer(const char* name, OGRwkbGeometryType type, const std::string& system) const {
    OGRSpatialReferenceH srs = OSRNewSpatialReference(nullptr);
    OSRSetFromUserInput(srs, system.c_str());
    OSRSetAxisMappingStrategy(srs, OAMS_TRADITIONAL_GIS_ORDER);
    // With its index, a newer FlatGeobuf takes no feature without a geometry.
    const bool is_flat = std::string(GDALGetDriverShortName(GDALGetDatasetDriver(data_))) == "FlatGeobuf";
    char** const options = is_flat ? CSLSetNameValue(nullptr, "SPATIAL_INDEX", "NO") : nullptr;
    OGRLayerH layer = GDALDatasetCreateLayer(data_, name, srs, type, options);
    CSLDestroy(options);
    OSRRelease(srs);
    for (const auto& [field, field_type] :
         {std::pair{"kind", OFTString}, std::pair{"number", OFTInteger}, std::pair{"value", OFTReal}}) {
      OGRFieldDefnH definition = OGR_Fld_Create(field, field_type);
      OGR_L_CreateField(layer, definition, 1);
      OGR_Fld_Destroy(definition);
    }
    return layer;
  }

  /// Points in turn of kind a and b, number 1 and 2 and value 0.1 and 100000; the seventh has no kind.
  void add_points(OGRLayerH layer, const Points& points) const {
    GDALDatasetStartTransaction(data_, 0);
    for (std::size_t i = 0; i < points.size(); ++i) {
      OGRGeometryH geometry = OGR_G_CreateGeometry(wkbPoint);
      OGR_G_SetPoint_2D(geometry, 0, points[i].x, points[i].y);
      const bool is_odd = i % 2 == 1;
      OGRFeatureH feature = OGR_F_Create(OGR_L_GetLayerDefn(layer));
      if (i != 6) OGR_F_SetFieldString(feature, 0, is_odd ? "b" : "a");
      OGR_F_SetFieldInteger(feature, 1, is_odd ? 2 : 1);
      OGR_F_SetFieldDouble(feature, 2, is_odd ? 100000 : 0.1);
      OGR_F_SetGeometryDirectly(feature, geometry);
      EXPECT_EQ(OGR_L_CreateFeature(layer, feature), OGRERR_NONE);
      OGR_F_Destroy(feature);
    }
    // A feature without a geometry is none of a point.
    OGRFeatureH nothing = OGR_F_Create(OGR_L_GetLayerDefn(layer));
    EXPECT_EQ(OGR_L_CreateFeature(layer, nothing), OGRERR_NONE);
    OGR_F_Destroy(nothing);
    GDALDatasetCommitTransaction(data_);
  }

  /// One feature of this geometry.
  static void add_wkt(OGRLayerH layer, std::string wkt) {
    OGRGeometryH geometry = nullptr;
    char* text = wkt.data();
    ASSERT_EQ(OGR_G_CreateFromWkt(&text, nullptr, &geometry), OGRERR_NONE);
    OGRFeatureH feature = OGR_F_Create(OGR_L_GetLayerDefn(layer));
    OGR_F_SetGeometryDirectly(feature, geometry);
    EXPECT_EQ(OGR_L_CreateFeature(layer, feature), OGRERR_NONE);
    OGR_F_Destroy(feature);
  }

 private:
  GDALDatasetH data_;
};

/// What came out, read by GDAL itself.
struct ReadFeature {
  std::map<std::string, std::string> fields;
  std::string wkb;
};
struct ReadLayer {
  std::string name;
  std::string system;  ///< "EPSG:25832", or the name of one without a number
  std::vector<ReadFeature> features;
};

std::vector<ReadLayer> read_layers(const std::string& path) {
  const std::unique_ptr<void, decltype(&GDALClose)> data(
      GDALOpenEx(path.c_str(), GDAL_OF_VECTOR, nullptr, nullptr, nullptr), &GDALClose);
  std::vector<ReadLayer> layers;
  for (int l = 0; data && l < GDALDatasetGetLayerCount(data.get()); ++l) {
    OGRLayerH layer = GDALDatasetGetLayer(data.get(), l);
    layers.push_back({OGR_L_GetName(layer), "", {}});
    OGRSpatialReferenceH srs = OGR_L_GetSpatialRef(layer);
    if (srs != nullptr) {
      const char* const code = OSRGetAuthorityCode(srs, nullptr);
      layers.back().system = code != nullptr ? std::string("EPSG:") + code : OSRGetName(srs);
    }
    for (OGRFeatureH feature = OGR_L_GetNextFeature(layer); feature != nullptr;
         feature = OGR_L_GetNextFeature(layer)) {
      ReadFeature read;
      for (int f = 0; f < OGR_F_GetFieldCount(feature); ++f) {
        read.fields[OGR_Fld_GetNameRef(OGR_F_GetFieldDefnRef(feature, f))] =
            OGR_F_GetFieldAsString(feature, f);
      }
      if (OGRGeometryH geometry = OGR_F_GetGeometryRef(feature)) {
        read.wkb.resize(static_cast<std::size_t>(OGR_G_WkbSize(geometry)));
        OGR_G_ExportToIsoWkb(geometry, wkbNDR, reinterpret_cast<unsigned char*>(read.wkb.data()));
      }
      layers.back().features.push_back(std::move(read));
      OGR_F_Destroy(feature);
    }
  }
  return layers;
}

class VectorFormatsTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { GDALAllRegister(); }

  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string file(const std::string& name, const std::string& text) const {
    write_text(path(name), text);
    return path(name);
  }
  std::string csv() const { return file("points.csv", rows(points_, ",")); }
  /// The points as a layer.
  std::string layer_file(const std::string& name, const char* driver,
                         const std::string& system = "EPSG:25832") const {
    const NewData data(path(name), driver);
    data.add_points(data.layer("points", wkbPoint, system), points_);
    return path(name);
  }
  static Outcome run(const std::vector<std::string>& arguments) {
    return run_program(joined({POLYLIDAR_WITH_GDAL}, arguments));
  }
  static std::string result(const std::vector<std::string>& arguments) {
    return succeeded(run(arguments)).out;
  }
  /// The only layer of a file.
  static ReadLayer layer_of(const std::string& written) {
    std::vector<ReadLayer> layers = read_layers(written);
    if (layers.size() == 1) return layers[0];
    ADD_FAILURE() << written << " has " << layers.size() << " layers";
    return {};
  }
  static ReadFeature feature_of(const ReadLayer& layer) {
    if (layer.features.size() == 1) return layer.features[0];
    ADD_FAILURE() << layer.name << " has " << layer.features.size() << " features";
    return {};
  }

  TemporaryFolder folder_;
  Points points_ = utm_square_without_a_disc();
};

TEST_F(VectorFormatsTest, ThePolygonsAreThoseOfTheSamePointsAsText) {
  const std::string wkb = result({"hull", csv(), "--format", "wkb"});
  ASSERT_GT(wkb.size(), 1000U);
  EXPECT_EQ(result({"hull", layer_file("points.gpkg", "GPKG"), "--format", "wkb"}), wkb);
  EXPECT_EQ(result({"hull", layer_file("points.fgb", "FlatGeobuf"), "--format", "wkb"}).size(), wkb.size())
      << "another order of the points, so that rings start elsewhere";
  EXPECT_EQ(result({"hull", layer_file("points.shp", "ESRI Shapefile"), "--format", "wkb"}), wkb);
  // Not by the ending.
  fs::copy(path("points.gpkg"), path("points.dat"));
  EXPECT_EQ(result({"hull", path("points.dat"), "--input", "gdal", "--format", "wkb"}), wkb);
  expect_refusal(run({"hull", path("points.dat")}), 2,
                 "it is a database of SQLite, such as a GeoPackage; name it .gpkg");
  // Several points a feature.
  {
    const NewData data(path("multi.gpkg"), "GPKG");
    NewData::add_wkt(data.layer("points", wkbMultiPoint, "EPSG:25832"),
                     "MULTIPOINT (" + listed(points_, "(", " ", ")") + ")");
  }
  EXPECT_EQ(result({"hull", path("multi.gpkg"), "--format", "wkb"}), wkb);
}

TEST_F(VectorFormatsTest, FilesOfPolygons) {
  const std::string wkb = result({"hull", csv(), "--format", "wkb"});
  const json properties = json::parse(result({"hull", csv()}))["properties"];
  for (const std::string ending : {"gpkg", "fgb", "shp"}) {
    const std::string out = path("out." + ending);
    // The second time there is such a file.
    for (int time = 0; time < 2; ++time) {
      EXPECT_EQ(result({"hull", csv(), "--crs", "EPSG:25832", "-o", out}), "");
    }
    const ReadLayer layer = layer_of(out);
    EXPECT_EQ(layer.name, "out");
    EXPECT_EQ(layer.system, "EPSG:25832");
    const ReadFeature feature = feature_of(layer);
    EXPECT_EQ(feature.fields.at("points"), "4000");
    EXPECT_EQ(feature.fields.at("parts"), "1");
    EXPECT_EQ(feature.fields.at("holes"), "1");
    EXPECT_NEAR(std::stod(feature.fields.at("area")), properties["area"].get<double>(), 1e-6);
    // Shapefiles have their rings the other way round and one part as a Polygon.
    if (ending == "shp") continue;
    EXPECT_NEAR(std::stod(feature.fields.at("median_size")), properties["median_size"].get<double>(), 1e-12);
    EXPECT_EQ(feature.wkb, wkb);
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_.path())) {
    EXPECT_EQ(entry.path().string().find("unfinished"), std::string::npos) << entry.path();
  }
  EXPECT_EQ(result({"hull", csv(), "-o", path("other.dat"), "--format", "gdal:GPKG", "--out-layer", "lakes"}),
            "");
  EXPECT_EQ(layer_of(path("other.dat")).name, "lakes");
  EXPECT_EQ(layer_of(path("other.dat")).system.find("EPSG:"), std::string::npos) << "none is known";
}

TEST_F(VectorFormatsTest, OutliersBesidePolygonsNeedAFormatThatHoldsBoth) {
  expect_refusal(run({"hull", csv(), "--keep-outliers", "-o", path("out.shp")}), 2, "name it .gpkg");
  for (const std::string driver : {"gdal:ESRI Shapefile", "gdal:esri shapefile"}) {
    expect_refusal(run({"hull", csv(), "--keep-outliers", "-o", path("o"), "--format", driver}), 2,
                   "name it .gpkg");
  }
  EXPECT_EQ(result({"hull", csv(), "--alpha", "0.02", "--keep-outliers", "-o", path("out.gpkg")}), "");
  EXPECT_EQ(layer_of(path("out.gpkg")).features.size(), 2U);
}

TEST_F(VectorFormatsTest, AReplacedFileKeepsItsMode) {
  constexpr fs::perms kPrivate = fs::perms::owner_read | fs::perms::owner_write;
  for (const std::string ending : {"gpkg", "fgb", "shp"}) {
    const std::string out = path("out." + ending);
    EXPECT_EQ(result({"hull", csv(), "-o", out}), "");
    fs::permissions(out, kPrivate);
    if (ending == "shp") fs::permissions(path("out.dbf"), kPrivate | fs::perms::group_read);
    EXPECT_EQ(result({"hull", csv(), "--crs", "EPSG:25832", "-o", out}), "");
    EXPECT_EQ(fs::status(out).permissions(), kPrivate) << ending;
  }
  EXPECT_EQ(fs::status(path("out.dbf")).permissions(), kPrivate | fs::perms::group_read);
  EXPECT_EQ(fs::status(path("out.prj")).permissions(), kPrivate) << "new beside the private one";
}

TEST_F(VectorFormatsTest, NothingOfTheFileBeforeIsLeft) {
  const std::string out = path("out.shp");
  EXPECT_EQ(result({"hull", csv(), "--crs", "EPSG:25832", "-o", out}), "");
  ASSERT_TRUE(fs::exists(path("out.prj")));
  file("out.txt", "no part of it");
  EXPECT_EQ(result({"hull", csv(), "-o", out}), "");
  EXPECT_FALSE(fs::exists(path("out.prj"))) << "the system of the file before";
  EXPECT_EQ(layer_of(out).system, "");
  EXPECT_TRUE(fs::exists(path("out.txt")));
}

/// All files of a folder and what they hold.
std::map<std::string, std::string> texts_in(const fs::path& folder) {
  std::map<std::string, std::string> texts;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    texts[entry.path().filename().string()] = read_text(entry.path());
  return texts;
}

TEST_F(VectorFormatsTest, NoPartOfWhatIsReadIsReplaced) {
  const std::string shp = layer_file("points.shp", "ESRI Shapefile");
  const std::string table = file("s.csv", rows(points_, ","));
  fs::copy(path("points.prj"), path("s.prj"));
  const std::map<std::string, std::string> before = texts_in(folder_.path());
  const std::string refused = "--out " + shp + " would replace " + shp + ", which is read with ";
  for (const std::string part : {"points.shx", "points.dbf"})
    expect_refusal(run({"hull", path(part), "--input", "gdal", "-o", shp}), 2, refused + path(part));
  // A folder is a data set, too.
  expect_refusal(run({"hull", folder_.path().string(), "--input", "gdal", "--layer", "points", "-o", shp}), 2,
                 "points.shp, which is read with " + folder_.path().string());
  for (const std::string system : {"EPSG:25832", "none"}) {
    expect_refusal(run({"hull", table, "--crs", system, "-o", path("s.shp")}), 2,
                   "s.shp would also replace " + path("s.prj"));
  }
  expect_refusal(run({"hull", table, "-o", path("s.prj"), "--format", "wkt"}), 2,
                 "s.prj, which is read with " + table);
  EXPECT_EQ(texts_in(folder_.path()), before);

  // The .prj of a Shapefile is its own, and so the same command may run again.
  fs::remove(path("s.prj"));
  for (int time = 0; time < 2; ++time)
    EXPECT_EQ(result({"hull", table, "--crs", "EPSG:25832", "-o", path("s.shp")}), "");
  EXPECT_EQ(result({"footprint", table, "-o", path("s.shp")}), "");
}

TEST_F(VectorFormatsTest, NoFileOfOthersBesideIsReplaced) {
  for (const std::string other : {"out.dbf", "out.shx", "out.prj", "out.cpg"}) {
    file(other, "of others");
    expect_refusal(run({"hull", csv(), "-o", path("out.shp")}), 2,
                   "out.shp would also replace " + path(other) + ", which is no part of it");
    EXPECT_EQ(read_text(path(other)), "of others");
    EXPECT_FALSE(fs::exists(path("out.shp")));
    fs::remove(path(other));
  }
  file("out.xsd", "of others");
  expect_refusal(run({"hull", csv(), "-o", path("out.gml")}), 2, "out.gml would also replace");
  fs::remove(path("out.xsd"));
  // Its own files are.
  for (const std::string ending : {"gml", "tab"}) {
    for (int time = 0; time < 2; ++time) EXPECT_EQ(result({"hull", csv(), "-o", path("out." + ending)}), "");
    EXPECT_EQ(layer_of(path("out." + ending)).features.size(), 1U);
  }
}

TEST_F(VectorFormatsTest, RastersAreNotLost) {
  {
    GDALDatasetH data =
        GDALCreate(GDALGetDriverByName("GPKG"), path("site.gpkg").c_str(), 16, 16, 1, GDT_Byte, nullptr);
    ASSERT_NE(data, nullptr);
    std::array<double, 6> place = {500000, 1, 0, 5600016, 0, -1};
    GDALSetGeoTransform(data, place.data());
    std::array<unsigned char, 256> values = {1, 2, 3};
    EXPECT_EQ(GDALDatasetRasterIO(data, GF_Write, 0, 0, 16, 16, values.data(), 16, 16, GDT_Byte, 1, nullptr,
                                  0, 0, 0),
              CE_None);
    GDALClose(data);
  }
  const std::string before = read_text(path("site.gpkg"));
  expect_refusal(run({"hull", csv(), "-o", path("site.gpkg")}), 2,
                 "site.gpkg has raster data, which would be lost; give another file");
  EXPECT_EQ(read_text(path("site.gpkg")), before);
  // A PDF is both, and may be replaced.
  if (GDALGetDriverByName("PDF") == nullptr) return;
  for (int time = 0; time < 2; ++time)
    EXPECT_EQ(result({"hull", csv(), "-o", path("o.pdf"), "--format", "gdal:PDF"}), "");
}

TEST_F(VectorFormatsTest, AFormatWithoutPolygonsIsRefused) {
  for (const auto& [driver, name] :
       {std::pair{"CSV", "out.csv"}, std::pair{"ODS", "out.ods"}, std::pair{"XLSX", "out.xlsx"}}) {
    if (GDALGetDriverByName(driver) == nullptr) continue;
    expect_refusal(
        run({"hull", csv(), "-o", path(name), "--format", std::string("gdal:") + driver}), 2,
        std::string("GDAL's driver '") + driver + "' writes none of these polygons; name another one");
  }
  expect_refusal(run({"hull", csv(), "-o", path("out.dat"), "--format", "gdal:Memory"}), 2,
                 "writes no file named out.dat");
  // Of tiles for maps of continents a hundred metres are nothing, which is known at the end only.
  expect_end(run({"hull", csv(), "--crs", "25832", "-o", path("out.mbtiles"), "--format", "gdal:MBTiles"}), 2,
             "GDAL's driver 'MBTiles' writes none of these polygons");
  EXPECT_EQ(texts_in(folder_.path()).size(), 1U) << "the points";
}

TEST_F(VectorFormatsTest, LabelsStayAsTheyAre) {
  const auto grouped = [&](const std::string& a, const std::string& b) {
    std::string text = "x,y,kind\n";
    for (std::size_t i = 0; i < points_.size(); ++i)
      text += number(points_[i].x) + "," + number(points_[i].y) + "," + (i % 2 == 0 ? a : b) + "\n";
    return file("grouped.csv", text);
  };
  const auto expect_labels = [&](const std::string& a, const std::string& b,
                                 const std::vector<std::string>& endings) {
    for (const std::string& ending : endings) {
      const std::string out = path("out." + ending);
      EXPECT_EQ(result({"hull", grouped(a, b), "--by", "kind", "-o", out}), "");
      const ReadLayer layer = layer_of(out);
      ASSERT_EQ(layer.features.size(), 2U) << ending;
      std::vector<std::string> labels;
      for (const ReadFeature& feature : layer.features) labels.push_back(feature.fields.at("label"));
      std::sort(labels.begin(), labels.end());
      EXPECT_EQ(labels, (std::vector<std::string>{a, b})) << ending;
    }
  };
  expect_labels("\u65e5\u672c", "\u6771\u4eac", {"shp", "gpkg", "fgb"});
  expect_labels("2020/1/5", "2020/11/25", {"shp", "gpkg", "fgb"});
  expect_labels("08:30", "9:15:00", {"shp", "gpkg", "fgb"});
  expect_labels("2020-01-05T08:30:00Z", "2020-01-05T8:30", {"shp", "gpkg", "fgb"});
  expect_labels(std::string(253, 'l') + "a", std::string(253, 'l') + "b", {"shp"});
  expect_labels(std::string(299, 'l') + "a", std::string(299, 'l') + "b", {"gpkg", "fgb"});
  const std::map<std::string, std::string> before = texts_in(folder_.path());
  expect_end(
      run({"hull", grouped(std::string(299, 'l') + "a", std::string(299, 'l') + "b"), "--by", "kind", "-o",
           path("out.shp")}),
      2, "out.shp cannot hold the label 'llllllllllllllllllllllllllllllllllllllll...' as it is; shorten it");
  std::map<std::string, std::string> after = texts_in(folder_.path());
  after["grouped.csv"] = before.at("grouped.csv");
  EXPECT_EQ(after, before);
}

TEST_F(VectorFormatsTest, WhatTheFormatLacksIsTold) {
  const Outcome laundered = succeeded(run({"hull", csv(), "-o", path("out.shp")}));
  const std::string name = "'median_size' to 'median_siz'";
  expect_says(laundered.err, "polylidar: " + path("out.shp") + ": ");
  expect_says(laundered.err, name);
  EXPECT_EQ(laundered.err.find(name), laundered.err.rfind(name)) << "once";
  expect_says(succeeded(run({"footprint", csv(), "-o", path("out.shp")})).err, name);
  EXPECT_FALSE(contains(succeeded(run({"hull", csv(), "-o", path("out.gpkg")})).err, "out.gpkg"));

  const std::string note = ": the coordinates are transformed to WGS 84";
  for (const std::string ending : {"kml", "geojsonl"}) {
    const std::string out = path("out." + ending);
    const Outcome metres = succeeded(run({"hull", csv(), "--crs", "EPSG:25832", "-o", out}));
    expect_says(metres.err, out + note);
    EXPECT_FALSE(contains(metres.err, "Target SRS")) << metres.err;
    EXPECT_EQ(layer_of(out).system, "EPSG:4326");
    const std::string degrees = file("degrees.csv", "x,y\n7.1,50.1\n7.2,50.1\n7.1,50.2\n7.2,50.2\n");
    const Outcome same = succeeded(run({"hull", degrees, "--crs", "EPSG:4326", "-o", out}));
    EXPECT_FALSE(contains(same.err, note)) << same.err;
  }
  EXPECT_FALSE(contains(succeeded(run({"hull", csv(), "--crs", "EPSG:25832", "-o", path("system.shp")})).err,
                        "transformed"));
}

TEST_F(VectorFormatsTest, GroupsByAColumn) {
  const std::string gpkg = layer_file("points.gpkg", "GPKG");
  const json kinds = json::parse(result({"hull", gpkg, "--by", "kind"}));
  ASSERT_EQ(kinds["features"].size(), 3U);
  EXPECT_EQ("", kinds["features"][0]["properties"]["label"].get<std::string>());
  EXPECT_EQ("a", kinds["features"][1]["properties"]["label"].get<std::string>());
  EXPECT_EQ(kinds["features"][1]["properties"]["points"], 1999);
  EXPECT_EQ(kinds["features"][2]["properties"]["points"], 2000);
  EXPECT_EQ("urn:ogc:def:crs:EPSG::25832", kinds["crs"]["properties"]["name"].get<std::string>());
  const json numbers = json::parse(result({"hull", gpkg, "--by", "2"}));
  EXPECT_EQ(numbers["features"][1]["properties"]["label"], 2);
  const json values = json::parse(result({"hull", gpkg, "--by", "value"}));
  EXPECT_EQ(values["features"][0]["properties"]["label"], 0.1);
  EXPECT_EQ(values["features"][1]["properties"]["label"], 100000);
  expect_refusal(run({"hull", gpkg, "--by", "species"}), 2,
                 "--by 'species' names no column; the columns are 'kind', 'number', 'value'");

  EXPECT_EQ(result({"hull", gpkg, "--by", "number", "-o", path("out.gpkg")}), "");
  const ReadLayer layer = layer_of(path("out.gpkg"));
  ASSERT_EQ(layer.features.size(), 2U);
  EXPECT_EQ(layer.features[1].fields.at("label"), "2");
  EXPECT_EQ(layer.features[1].fields.at("points"), "2000");
}

TEST_F(VectorFormatsTest, TheVersionNamesGdal) {
  expect_says(result({"--version"}), std::string(", with GDAL ") + GDALVersionInfo("RELEASE_NAME"));
}

TEST_F(VectorFormatsTest, AWindowAndAStream) {
  const std::string gpkg = layer_file("points.gpkg", "GPKG");
  const std::string window = "500010,5600010,500060.5,5600090";
  // The index of the file gives them in another order, so that rings start elsewhere.
  const json from_layer = json::parse(result({"hull", gpkg, "--window", window}))["properties"];
  const json from_text = json::parse(result({"hull", csv(), "--window", window}))["properties"];
  EXPECT_EQ(from_layer["points"], from_text["points"]);
  EXPECT_LT(from_layer["points"], 3000);
  EXPECT_NEAR(from_layer["area"].get<double>(), from_text["area"].get<double>(), 1e-6);
  EXPECT_EQ(result({"hull", gpkg, "--max-perimeter", "8", "--stream"}),
            result({"hull", gpkg, "--max-perimeter", "8"}));
}

TEST_F(VectorFormatsTest, CoordinateSystemsPassThrough) {
  Points degrees;
  for (const Point& p : points_) degrees.push_back({10 + (p.x - 500000) / 1e3, 60 + (p.y - 5600000) / 2e3});
  points_ = degrees;
  const std::string gpkg = layer_file("degrees.gpkg", "GPKG", "EPSG:4326");
  EXPECT_EQ(result({"hull", gpkg, "-o", path("out.gpkg")}), "");
  const ReadLayer layer = layer_of(path("out.gpkg"));
  EXPECT_EQ(layer.system, "EPSG:4326");
  EXPECT_EQ(feature_of(layer).wkb, result({"hull", csv(), "--crs", "4326", "--format", "wkb"}));
  // 0.1 degrees of longitude at latitude 60 by 0.05 of latitude: both about 5.56 km.
  const double square = 5559.75 * 5559.75;
  EXPECT_NEAR(std::stod(feature_of(layer).fields.at("area")), square * (1 - 0.04 * 3.14159), 0.03 * square);

  // One without a number, which GeoJSON cannot name.
  points_ = utm_square_without_a_disc();
  const std::string mollweide =
      layer_file("mollweide.gpkg", "GPKG", "+proj=moll +lon_0=7 +datum=WGS84 +units=m");
  const Outcome named = run({"hull", mollweide, "-o", path("named.gpkg")});
  EXPECT_EQ(named.err.find("EPSG"), std::string::npos) << named.err;
  EXPECT_EQ(layer_of(path("named.gpkg")).system, layer_of(mollweide).system);
  EXPECT_NE(layer_of(mollweide).system, "");
  expect_says(run({"hull", mollweide}).err, "has no EPSG number");
}

TEST_F(VectorFormatsTest, AnIndexOfFootprintsAndAUnion) {
  LasFile las;
  for (const Point& p : points_) {
    las.points.push_back({.x = static_cast<std::int32_t>(std::lround((p.x - 500000) * 100)),
                          .y = static_cast<std::int32_t>(std::lround((p.y - 5600000) * 100)),
                          .classification = 2});
  }
  las.offset = {500100, 5600000};
  las.records = {projected(25832)};
  const std::vector<std::string> files = {layer_file("west.gpkg", "GPKG"), file("east.las", las.text())};
  const std::string out = path("index.gpkg");
  EXPECT_EQ(result({"footprint", files[0], files[1], "-o", out}), "");
  const ReadLayer index = layer_of(out);
  EXPECT_EQ(index.name, "index");
  EXPECT_EQ(index.system, "EPSG:25832");
  ASSERT_EQ(index.features.size(), 2U);
  EXPECT_EQ(index.features[0].fields.at("name"), "west.gpkg");
  EXPECT_EQ(index.features[1].fields.at("path"), files[1]);
  EXPECT_EQ(json::parse(index.features[1].fields.at("classes")), (json{{"2", 4000}}));
  EXPECT_EQ(json::parse(index.features[1].fields.at("bounds")).size(), 4U);

  const std::string united = path("united.fgb");
  EXPECT_EQ(result({"footprint", files[0], files[1], "--union", "-o", united}), "");
  const ReadFeature feature = feature_of(layer_of(united));
  EXPECT_EQ(feature.fields.at("files"), "2");
  EXPECT_EQ(feature.fields.at("points"), "8000");
  EXPECT_EQ(feature.fields.at("parts"), "1");
  EXPECT_EQ(feature.fields.at("holes"), "2");
}

TEST_F(VectorFormatsTest, WhatCannotBeRead) {
  const std::string gpkg = layer_file("points.gpkg", "GPKG");
  expect_refusal(run({"hull", path("none.gpkg")}), 2, "there is no file");
  expect_refusal(run({"hull", file("broken.gpkg", "SQLite format 3")}), 2,
                 "broken.gpkg: GDAL cannot read it");
  expect_refusal(run({"hull", gpkg, "--layer", "trees"}), 2,
                 "it has no layer 'trees'; its layers are 'points'");
  expect_refusal(run({"hull", gpkg, "--columns", "x,y"}), 2, "leave --columns out");
  expect_refusal(run({"hull", gpkg, "--returns", "first"}), 2, "--returns and --classes are for LAS");
  expect_refusal(run({"hull", csv(), "--layer", "points"}), 2, "--layer is for what GDAL reads");
  {
    const NewData data(path("areas.gpkg"), "GPKG");
    NewData::add_wkt(data.layer("areas", wkbPolygon, "EPSG:25832"), "POLYGON ((0 0,1 0,0 1,0 0))");
  }
  expect_refusal(run({"hull", path("areas.gpkg")}), 2, "feature 1 is a Polygon and no set of points");
  {
    const NewData data(path("two.gpkg"), "GPKG");
    data.add_points(data.layer("trees", wkbPoint, "EPSG:25832"), points_);
    data.add_points(data.layer("shrubs", wkbPoint, "EPSG:25832"), {{0, 0}, {1, 0}, {0, 1}});
    NewData::add_wkt(data.layer("areas", wkbPolygon, "EPSG:25832"), "POLYGON ((0 0,1 0,0 1,0 0))");
  }
  expect_refusal(run({"hull", path("two.gpkg")}), 2,
                 "it has the layers 'trees', 'shrubs', 'areas'; name the one with the points by --layer");
  EXPECT_EQ(json::parse(result({"hull", path("two.gpkg"), "--layer", "shrubs"}))["properties"]["points"], 3);
  const Outcome index =
      expect_end(run({"footprint", gpkg, path("areas.gpkg"), "PG:dbname=x"}), 4, "footprints are of files");
  expect_says(index.err, "1 of 3 files are in the index");
}

TEST_F(VectorFormatsTest, WhatCannotBeWritten) {
  const auto to = [&](const std::string& out, const std::vector<std::string>& more = {}) {
    return run(joined({"hull", csv(), "-o", out}, more));
  };
  expect_refusal(to("/nowhere/out.gpkg"), 1, "cannot write /nowhere/out.gpkg");
  expect_refusal(to(path("out.gpkg"), {"--format", "gdal:Nothing"}), 2, "this GDAL has no driver 'Nothing'");
  expect_refusal(to(path("out.unknown"), {"--format", "gdal:"}), 2, "name one by --format, as in gdal:GPKG");
  expect_refusal(run({"hull", csv(), "--format", "gdal:GPKG"}), 2, "needs a file or a database");
  expect_refusal(to(path("out.geojson"), {"--out-layer", "x"}), 2, "--out-layer is for what GDAL writes");
  expect_refusal(to("PG:host=/nowhere dbname=none"), 1, "cannot write PG:host=/nowhere dbname=none");
  const std::string others = layer_file("others.gpkg", "GPKG");
  const std::string before = read_text(others);
  expect_refusal(to(others), 2, "others.gpkg has a layer 'points', which would be lost");
  EXPECT_EQ(read_text(others), before);
  file("others.gpkg-wal", "");
  expect_refusal(to(others, {"--out-layer", "points"}), 2, "others.gpkg is open in another program");
  EXPECT_EQ(read_text(others), before);
}

#ifdef HULLBENCH_HAS_POSTGRES
TEST_F(VectorFormatsTest, ADatabase) {
  std::optional<PrivatePostgres> server;
  try {
    server.emplace();
  } catch (const NotInstalled& error) {
    GTEST_SKIP() << "skipped: " << error.what();
  }
  const std::string database = "PG:" + server->dsn();
  NewData(database, "").execute("CREATE EXTENSION IF NOT EXISTS postgis");
  {
    const NewData data(database, "");
    data.add_points(data.layer("trees", wkbPoint, "EPSG:25832"), points_);
    data.add_points(data.layer("shrubs", wkbPoint, "EPSG:25832"), points_);
  }
  const std::string wkb = result({"hull", csv(), "--format", "wkb"});
  EXPECT_EQ(result({"hull", database, "--layer", "trees", "--format", "wkb"}), wkb);
  expect_refusal(run({"hull", database}), 2, "name the one with the points by --layer");
  EXPECT_EQ(result({"hull", database, "--layer", "trees", "-o", database, "--out-layer", "stands"}), "");
  expect_refusal(run({"hull", csv(), "-o", database, "--out-layer", "stands"}), 2,
                 "has a table 'stands' already");
  const std::vector<ReadLayer> layers = read_layers(database);
  const auto stands =
      std::ranges::find_if(layers, [](const ReadLayer& layer) { return layer.name == "stands"; });
  ASSERT_NE(stands, layers.end());
  EXPECT_EQ(stands->system, "EPSG:25832");
  EXPECT_EQ(feature_of(*stands).wkb, wkb);
  EXPECT_EQ(feature_of(*stands).fields.at("points"), "4000");
}
#endif

}  // namespace
}  // namespace hullbench::testing
