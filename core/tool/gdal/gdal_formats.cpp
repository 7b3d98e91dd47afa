#include "tool/gdal/gdal_formats.hpp"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <fcntl.h>
#include <gdal.h>
#include <gdal_utils.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "tool/gdal/gdal_data.hpp"
#include "tool/gdal/layer_content.hpp"
#include "tool/points/labels.hpp"
#include "tool/points/numbers.hpp"
#include "tool/points/readers.hpp"
#include "tool/program/configuration_error.hpp"
#include "tool/program/interrupt.hpp"
#include "tool/program/letter_case.hpp"
#include "tool/program/result_output.hpp"

namespace polylidar::tool {
namespace {

namespace fs = std::filesystem;
using point_files::in_quotes;

/// "a, b, c", the first of them.
std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 12;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i)
    text += (i > 0 ? ", " : "") + in_quotes(names[i]);
  return names.size() > kMost ? text + " and others" : text;
}

std::vector<std::string> names_of(const std::vector<OGRLayerH>& layers) {
  std::vector<std::string> names(layers.size());
  std::transform(layers.begin(), layers.end(), names.begin(), &OGR_L_GetName);
  return names;
}

bool is_of_points(OGRLayerH layer) {
  const OGRwkbGeometryType type = OGR_GT_Flatten(OGR_L_GetGeomType(layer));
  return type == wkbPoint || type == wkbMultiPoint;
}

Crs crs_of(OGRSpatialReferenceH system) {
  if (system == nullptr) return {};
  const char* const authority = OSRGetAuthorityName(system, nullptr);
  const char* const code = OSRGetAuthorityCode(system, nullptr);
  if (authority != nullptr && code != nullptr) {
    if (std::optional<Crs> crs = crs_of_name(std::string(authority) + ":" + code)) {
      crs->is_geographic = OSRIsGeographic(system) != 0;
      return *crs;
    }
  }
  char* text = nullptr;
  OSRExportToWkt(system, &text);
  const std::unique_ptr<char, void (*)(void*)> owned(text, &VSIFree);
  return text == nullptr ? Crs() : crs_of_wkt(text).value_or(Crs());
}

/// One layer's points.
class LayerReader {
 public:
  LayerReader(std::string path, const PointFileOptions& options)
      : path_(std::move(path)), options_(options) {}

  PointFile read() {
    check_options();
    GdalErrors errors;
    VSIStatBufL status{};
    if (!is_database(path_) && VSIStatL(path_.c_str(), &status) != 0) {
      throw PointFileError("there is no file " + path_ + " to read points from");
    }
    size_ = static_cast<std::uint64_t>(status.st_size);
    const Dataset dataset = open(path_);
    if (!dataset) fail("GDAL cannot read it" + errors.said());
    OGRLayerH layer = layer_of(dataset.get());
    file_.crs = crs_of(OGR_L_GetSpatialRef(layer));
    if (!options_.by.empty()) find_field(layer);
    if (const auto& window = options_.window) {
      OGR_L_SetSpatialFilterRect(layer, window->min.x, window->min.y, window->max.x, window->max.y);
    }
    count_ = OGR_L_GetFeatureCount(layer, 0);
    OGR_L_ResetReading(layer);
    while (const Feature feature{OGR_L_GetNextFeature(layer)}) add(feature.get());
    if (errors.any()) fail("GDAL cannot read all of it" + errors.said());
    point_files::hand_on(file_, options_, true);
    if (field_) labels_.finish(file_);
    return std::move(file_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw PointFileError(path_ + ": " + what); }

  void check_options() const {
    if (!options_.columns.empty()) {
      fail("--columns is for columns of text, and this is a layer of geometries; leave --columns out");
    }
    if (options_.returns != Returns::kAll || options_.classes) {
      fail("--returns and --classes are for LAS, and this file is not; leave them out");
    }
  }

  OGRLayerH layer_of(GDALDatasetH dataset) const {
    std::vector<OGRLayerH> layers = layers_of(dataset);
    const std::string names = listed(names_of(layers));
    if (!options_.layer.empty()) {
      OGRLayerH layer = GDALDatasetGetLayerByName(dataset, options_.layer.c_str());
      if (layer == nullptr)
        fail("it has no layer " + in_quotes(options_.layer) + "; its layers are " + names);
      return layer;
    }
    std::erase_if(layers, [](OGRLayerH layer) { return OGR_L_GetGeomType(layer) == wkbNone; });
    if (layers.empty()) fail("it has no layer with geometries; give a layer of points");
    if (layers.size() > 1) std::erase_if(layers, std::not_fn(&is_of_points));
    if (layers.size() != 1) fail("it has the layers " + names + "; name the one with the points by --layer");
    return layers.front();
  }

  void find_field(OGRLayerH layer) {
    OGRFeatureDefnH fields = OGR_L_GetLayerDefn(layer);
    const int count = OGR_FD_GetFieldCount(fields);
    int field = OGR_FD_GetFieldIndex(fields, options_.by.c_str());
    const auto number = point_files::parse_count(options_.by);
    if (field < 0 && number && *number <= static_cast<std::uint64_t>(count))
      field = static_cast<int>(*number) - 1;
    if (field < 0) {
      std::vector<std::string> names(static_cast<std::size_t>(count));
      for (int f = 0; f < count; ++f) {
        names[static_cast<std::size_t>(f)] = OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(fields, f));
      }
      fail("--by " + in_quotes(options_.by) + " names no column; " +
           (names.empty() ? "there is none" : "the columns are " + listed(names)));
    }
    field_ = field;
    is_real_ = OGR_Fld_GetType(OGR_FD_GetFieldDefn(fields, field)) == OFTReal;
  }

  std::uint32_t group_of(OGRFeatureH feature) {
    if (OGR_F_IsFieldSetAndNotNull(feature, *field_) == 0) return labels_.index_of("");
    // With all digits, as text has them.
    if (is_real_)
      return labels_.index_of(point_files::plain_decimal(OGR_F_GetFieldAsDouble(feature, *field_)));
    return labels_.index_of(OGR_F_GetFieldAsString(feature, *field_));
  }

  void add(OGRFeatureH feature) {
    constexpr std::uint64_t kFeaturesBetweenLooks = 4096;
    if (++done_ % kFeaturesBetweenLooks == 0) tell();
    OGRGeometryH geometry = OGR_F_GetGeometryRef(feature);
    if (geometry == nullptr) return;
    const std::size_t before = file_.points.size();
    add_geometry(geometry);
    if (field_ && file_.points.size() > before) file_.groups.resize(file_.points.size(), group_of(feature));
    point_files::hand_on(file_, options_);
  }

  void add_geometry(OGRGeometryH geometry) {
    const OGRwkbGeometryType type = OGR_GT_Flatten(OGR_G_GetGeometryType(geometry));
    if (type == wkbPoint) {
      if (OGR_G_IsEmpty(geometry) == 0) add_point({OGR_G_GetX(geometry, 0), OGR_G_GetY(geometry, 0)});
    } else if (type == wkbMultiPoint || type == wkbGeometryCollection) {
      for (int i = 0; i < OGR_G_GetGeometryCount(geometry); ++i)
        add_geometry(OGR_G_GetGeometryRef(geometry, i));
    } else {
      fail("feature " + std::to_string(done_) + " is a " + OGRGeometryTypeToName(type) +
           " and no set of points; give a layer of points");
    }
  }

  void add_point(const Point& point) {
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) {
      fail("feature " + std::to_string(done_) + " has a coordinate that is not finite; remove the point");
    }
    if (options_.window && !point_files::is_inside(point, *options_.window)) return;
    file_.points.push_back(point);
  }

  /// Of a file the share of its features as a share of its bytes; of a database what its points took on the
  /// way, in well-known binary.
  void tell() const {
    constexpr std::uint64_t kBytesAPoint = 21;
    if (!options_.on_progress) return;
    if (size_ == 0 || count_ <= 0) return options_.on_progress(done_ * kBytesAPoint, {});
    const double share = std::min(1.0, static_cast<double>(done_) / static_cast<double>(count_));
    options_.on_progress(static_cast<std::uint64_t>(static_cast<double>(size_) * share), size_);
  }

  std::string path_;
  const PointFileOptions& options_;
  PointFile file_;
  std::uint64_t size_ = 0;    ///< bytes; 0: not known
  GIntBig count_ = -1;        ///< features; -1: not known
  std::uint64_t done_ = 0;    ///< features
  std::optional<int> field_;  ///< what is grouped by
  bool is_real_ = false;      ///< the field holds floating-point numbers
  point_files::Labels labels_;
};

/// Whether `word` is one of those between the blanks of `list`, which may be null, in any case.
bool is_listed(std::string_view word, const char* list) {
  for (std::string_view rest = list == nullptr ? "" : list; !rest.empty();) {
    const std::string_view next = rest.substr(0, rest.find(' '));
    if (equal_in_any_case(word, next)) return true;
    rest.remove_prefix(std::min(rest.size(), next.size() + 1));
  }
  return false;
}

bool can(GDALDriverH driver, const char* what) {
  return GDALGetMetadataItem(driver, what, nullptr) != nullptr;
}

/// The driver that is named, or the first one that writes vectors under this ending or beginning.
GDALDriverH driver_of(const VectorOutput& output) {
  const auto writes = [](GDALDriverH driver) {
    return driver != nullptr && can(driver, GDAL_DCAP_VECTOR) && can(driver, GDAL_DCAP_CREATE);
  };
  if (!output.driver.empty()) {
    GDALDriverH driver = GDALGetDriverByName(output.driver.c_str());
    if (writes(driver)) return driver;
    throw ConfigurationError("this GDAL has no driver " + in_quotes(output.driver) +
                             " that writes polygons; 'ogrinfo --formats' lists those that can ('w')");
  }
  const std::string ending = fs::path(output.path).extension().string();
  for (int d = 0; d < GDALGetDriverCount(); ++d) {
    GDALDriverH driver = GDALGetDriver(d);
    if (!writes(driver)) continue;
    const char* const beginning = GDALGetMetadataItem(driver, GDAL_DMD_CONNECTION_PREFIX, nullptr);
    if (beginning != nullptr && *beginning != '\0' && output.path.starts_with(beginning)) return driver;
    const char* const endings = GDALGetMetadataItem(driver, GDAL_DMD_EXTENSIONS, nullptr);
    if (!is_database(output.path) && ending.size() > 1 &&
        is_listed(std::string_view(ending).substr(1), endings)) {
      return driver;
    }
  }
  throw ConfigurationError("this GDAL has no driver that writes " + output.path +
                           "; name one by --format, as in gdal:GPKG ('ogrinfo --formats' lists them)");
}

std::string layer_name(const VectorOutput& output) {
  if (!output.layer.empty()) return output.layer;
  return is_database(output.path) ? "polylidar" : fs::path(output.path).stem().string();
}

/// Removes a folder with all that is in it.
class TemporaryFolder {
 public:
  /// One that an ended program of the same number has left is replaced.
  explicit TemporaryFolder(fs::path path) : path_(std::move(path)) {
    fs::remove_all(path_);
    fs::create_directory(path_);
    // What replaces a private file is never for others. Some file systems have no modes.
    std::error_code ignored;
    fs::permissions(path_, fs::perms::owner_all, ignored);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// Bytes as a file of GDAL's.
class MemoryFile {
 public:
  explicit MemoryFile(std::string bytes)
      : bytes_(std::move(bytes)), path_("/vsimem/polylidar-" + std::to_string(::getpid()) + ".geojson") {
    VSILFILE* const file =
        VSIFileFromMemBuffer(path_.c_str(), reinterpret_cast<GByte*>(bytes_.data()), bytes_.size(), FALSE);
    if (file == nullptr) throw std::runtime_error("GDAL takes no file in memory");
    (void)VSIFCloseL(file);
  }
  ~MemoryFile() { VSIUnlink(path_.c_str()); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string bytes_;
  std::string path_;
};

/// The features of GeoJSON, in which text stays text: GDAL would take some for dates.
Dataset open_features(const MemoryFile& geojson) {
  const char* const drivers[] = {"GeoJSON", nullptr};
  const char* const options[] = {"ARRAY_AS_STRING=YES", "DATE_AS_STRING=YES", nullptr};
  // Of outlines of any length.
  CPLSetThreadLocalConfigOption("OGR_GEOJSON_MAX_OBJ_SIZE", "0");
  return open(geojson.path(), drivers, options);
}

/// As GDAL takes it from text.
std::string system_text(const Crs& crs) {
  return crs.epsg > 0 ? crs.name() : crs.wkt.empty() ? "NONE" : crs.wkt;
}

/// The features of `source` into a new file or table. Returns what GDAL warns of.
std::vector<std::string> translate(GDALDatasetH source, const std::string& to, const VectorOutput& output,
                                   const Crs& crs) {
  const std::string driver = GDALGetDriverShortName(driver_of(output));
  std::vector<std::string> words = {"-f", driver, "-nln", layer_name(output), "-a_srs", system_text(crs)};
  if (driver == "ESRI Shapefile") words.insert(words.end(), {"-lco", "ENCODING=UTF-8"});
  std::vector<char*> arguments(words.size() + 1);
  std::ranges::transform(words, arguments.begin(), [](std::string& word) { return word.data(); });
  GdalErrors errors;
  const std::unique_ptr<GDALVectorTranslateOptions, void (*)(GDALVectorTranslateOptions*)> options(
      GDALVectorTranslateOptionsNew(arguments.data(), nullptr), &GDALVectorTranslateOptionsFree);
  const auto fail = [&] {
    throw std::runtime_error("cannot write " + output.path +
                             (errors.any() ? errors.said() : ": GDAL refuses"));
  };
  if (!options) fail();
  int is_misused = 0;
  GDALDatasetH sources[] = {source};
  Dataset written(GDALVectorTranslate(to.c_str(), nullptr, 1, sources, options.get(), &is_misused));
  if (!written) fail();
  // Much is written only now.
  written.reset();
  if (errors.any()) fail();
  return errors.warnings();
}

/// What the driver made of `source` in the files at `path`; nothing where GDAL only writes the format. Throws
/// ConfigurationError where no file of that name or no polygon is there.
std::optional<LayerContent> read_back(const LayerContent& source, const std::string& path,
                                      const VectorOutput& output) {
  GdalErrors unreadable;
  const std::string driver = GDALGetDriverShortName(driver_of(output));
  const char* const drivers[] = {driver.c_str(), nullptr};
  const auto fail = [&](const std::string& what) {
    throw ConfigurationError("GDAL's driver " + in_quotes(driver) + what +
                             "; name another one, as in gdal:GPKG, or ask for --format wkt");
  };
  VSIStatBufL status{};
  if (VSIStatL(path.c_str(), &status) != 0)
    fail(" writes no file named " + fs::path(path).filename().string());
  Dataset data = open(path, drivers);
  // A sequence of one GeoJSON is GeoJSON to GDAL.
  if (!data) data = open(path);
  if (!data) return {};
  LayerContent written = content_of(data.get());
  if (source.bounds && !written.bounds) fail(" writes none of these polygons");
  return written;
}

/// A folder of GDAL's in memory.
class MemoryFolder {
 public:
  MemoryFolder() : path_("/vsimem/polylidar-" + std::to_string(::getpid())) {
    if (VSIMkdir(path_.c_str(), 0700) != 0) throw std::runtime_error("GDAL makes no folder in memory");
  }
  ~MemoryFolder() { VSIRmdirRecursive(path_.c_str()); }
  MemoryFolder(const MemoryFolder&) = delete;
  MemoryFolder& operator=(const MemoryFolder&) = delete;

  const std::string& path() const { return path_; }
  std::vector<fs::path> names() const {
    std::vector<fs::path> names;
    char** const read = VSIReadDir(path_.c_str());
    for (char** name = read; name != nullptr && *name != nullptr; ++name) {
      if (fs::path name_in_folder = *name; name_in_folder != "." && name_in_folder != "..")
        names.push_back(std::move(name_in_folder));
    }
    CSLDestroy(read);
    return names;
  }

 private:
  std::string path_;
};

/// Writes a polygon into memory, so that what the driver lacks is known before the work. Returns the names of
/// the files that it makes; nothing where it does not write into memory. Throws ConfigurationError where it
/// writes no polygons.
std::vector<fs::path> try_out(const VectorOutput& output) {
  const MemoryFile feature(
      R"({"type": "Feature", "properties": {"label": "a"}, "geometry": {"type": "Polygon", "coordinates":
          [[[500000, 5600000], [600000, 5600000], [500000, 5700000], [500000, 5600000]]]}})");
  const MemoryFolder folder;
  const std::string path = folder.path() + "/" + fs::weakly_canonical(output.path).filename().string();
  const Dataset source = open_features(feature);
  if (!source) return {};
  try {
    translate(source.get(), path, output, crs_of_epsg(32632));
  } catch (const std::runtime_error&) {
    return {};
  }
  read_back(content_of(source.get()), path, output);
  return folder.names();
}

/// When something is to be read or written, as it takes a moment.
void register_drivers() {
  static std::once_flag once;
  std::call_once(once, &GDALAllRegister);
}

class GdalFormats final : public VectorFormats {
 public:
  PointFile read(const std::string& path, const PointFileOptions& options) const override {
    register_drivers();
    return LayerReader(path, options).read();
  }

  std::vector<std::string> files_of(const std::string& path) const override {
    register_drivers();
    GdalErrors unreadable;
    std::vector<std::string> files;
    for (const fs::path& file : files_of(open(path).get())) files.push_back(file.string());
    return files;
  }

  std::vector<std::string> check(const VectorOutput& output) const override {
    check_place(output);
    if (is_database(output.path)) return {};
    const fs::path target = fs::weakly_canonical(output.path);
    std::vector<fs::path> files = files_replaced_at(target, output);
    const std::vector<fs::path> parts = in_folder(target.parent_path(), try_out(output));
    if (files.empty()) check_are_free(parts, target, output);
    files.insert(files.end(), parts.begin(), parts.end());
    std::vector<std::string> beside;
    for (const fs::path& file : files) {
      if (file != target) beside.push_back(file.string());
    }
    return beside;
  }

  std::vector<std::string> write(const VectorOutput& output, std::string geojson,
                                 const Crs& crs) const override {
    check_place(output);
    const MemoryFile features(std::move(geojson));
    GdalErrors errors;
    const Dataset source = open_features(features);
    if (!source) throw std::runtime_error("cannot write " + output.path + errors.said());
    if (is_database(output.path)) return translate(source.get(), output.path, output, crs);
    return write_file(source.get(), output, crs);
  }

 private:
  static std::vector<fs::path> files_of(GDALDatasetH dataset) {
    std::vector<fs::path> files;
    char** const names = dataset == nullptr ? nullptr : GDALGetFileList(dataset);
    for (char** name = names; name != nullptr && *name != nullptr; ++name) files.emplace_back(*name);
    CSLDestroy(names);
    return files;
  }

  static void check_place(const VectorOutput& output) {
    register_drivers();
    driver_of(output);
    if (is_database(output.path)) return check_database(output);
    check_output_place(output.path);
    if (fs::exists(output.path)) check_replaced(output);
  }

  /// GDAL would append to a table that is there.
  static void check_database(const VectorOutput& output) {
    GdalErrors errors;
    const Dataset there = open(output.path);
    if (!there) throw std::runtime_error("cannot write " + output.path + errors.said());
    if (GDALDatasetGetLayerByName(there.get(), layer_name(output).c_str()) == nullptr) return;
    throw ConfigurationError(output.path + " has a table " + in_quotes(layer_name(output)) +
                             " already; name another one by --out-layer");
  }

  /// What a file holds beside the layer that is replaced would be lost.
  static void check_replaced(const VectorOutput& output) {
    // Else SQLite would play what stands there into the new file.
    if (fs::exists(output.path + "-wal"))
      throw ConfigurationError(output.path +
                               " is open in another program; close it there, or give another file");
    GdalErrors unreadable;
    const Dataset there = open(output.path);
    for (const std::string& name : names_of(there ? layers_of(there.get()) : std::vector<OGRLayerH>())) {
      if (name == layer_name(output)) continue;
      throw ConfigurationError(output.path + " has a layer " + in_quotes(name) +
                               ", which would be lost; give another file");
    }
    const Dataset rasters = open(output.path, nullptr, nullptr, GDAL_OF_RASTER);
    // Each page of a PDF is a raster, too.
    if (!rasters || std::string_view(GDALGetDriverShortName(GDALGetDatasetDriver(rasters.get()))) == "PDF")
      return;
    throw ConfigurationError(output.path + " has raster data, which would be lost; give another file");
  }

  /// Of the data set of the same format that `target` is, all files; none where it is no such data set.
  static std::vector<fs::path> files_replaced_at(const fs::path& target, const VectorOutput& output) {
    if (!fs::exists(target)) return {};
    GdalErrors unreadable;
    const char* const drivers[] = {GDALGetDriverShortName(driver_of(output)), nullptr};
    return files_of(open(target.string(), drivers).get());
  }

  static std::vector<fs::path> in_folder(const fs::path& folder, std::vector<fs::path> names) {
    for (fs::path& name : names) name = folder / name;
    return names;
  }

  /// Throws ConfigurationError where one of `parts` is there, unless it is `target`. For where no data set of
  /// the format is replaced, to which it could belong.
  static void check_are_free(const std::vector<fs::path>& parts, const fs::path& target,
                             const VectorOutput& output) {
    for (const fs::path& part : parts) {
      if (part == target || !fs::exists(fs::symlink_status(part))) continue;
      throw ConfigurationError("--out " + output.path + " would also replace " + part.string() +
                               ", which is no part of it; move that file, or give another name");
    }
  }

  /// Into a folder beside, as some formats are several files; these are moved when they are whole. Returns
  /// what is to be told.
  static std::vector<std::string> write_file(GDALDatasetH source, const VectorOutput& output,
                                             const Crs& crs) {
    const fs::path target = fs::weakly_canonical(output.path);
    const TemporaryFolder unfinished(unfinished_path(target).string());
    const std::string path = (unfinished.path() / target.filename()).string();
    std::vector<std::string> notes = translate(source, path, output, crs);
    throw_if_interrupted();
    compare(content_of(source), path, output, crs, notes);
    move(unfinished.path(), target, output);
    return notes;
  }

  /// Throws ConfigurationError where what was written at `path` lacks what `source` has, and notes what is
  /// changed.
  static void compare(const LayerContent& source, const std::string& path, const VectorOutput& output,
                      const Crs& crs, std::vector<std::string>& notes) {
    const std::optional<LayerContent> written = read_back(source, path, output);
    if (!written) return;
    if (const std::optional<std::string> label = changed_label(source, *written)) {
      throw ConfigurationError(output.path + " cannot hold the label " + in_quotes(*label) +
                               " as it is; shorten it, or name the output .gpkg");
    }
    GdalErrors unknown;
    const SpatialSystem system(OSRNewSpatialReference(nullptr));
    if (OSRSetFromUserInput(system.get(), system_text(crs).c_str()) != OGRERR_NONE) return;
    OSRSetAxisMappingStrategy(system.get(), OAMS_TRADITIONAL_GIS_ORDER);
    const std::optional<std::string> other = other_system(source, system.get(), *written);
    if (!other) return;
    // GDAL's own words for it are less plain.
    std::erase_if(notes, [](const std::string& note) { return note.starts_with("Target SRS "); });
    notes.push_back("the coordinates are transformed to " + *other +
                    ", as the format has them in no other system; name the output .gpkg to keep them");
  }

  /// The files in `folder` to where `target` is. Of the data set that was there nothing is left, such as a
  /// .prj or an index: it would be taken for a part of the new one.
  static void move(const fs::path& folder, const fs::path& target, const VectorOutput& output) {
    const std::vector<fs::path> replaced = files_replaced_at(target, output);
    std::vector<fs::path> files;
    for (const fs::directory_entry& part : fs::directory_iterator(folder))
      files.push_back(target.parent_path() / part.path().filename());
    if (replaced.empty()) check_are_free(files, target, output);
    for (const fs::path& old : replaced) {
      if (std::find(files.begin(), files.end(), old) == files.end()) fs::remove(old);
    }
    for (const fs::path& file : files) {
      const fs::path made = folder / file.filename();
      // What is new, such as a .cpg, is for nobody else either.
      keep_owner_and_mode(made, fs::exists(file) ? file : target, output.path);
      fs::rename(made, file);
    }
  }

  static void keep_owner_and_mode(const fs::path& made, const fs::path& replaced, const std::string& name) {
    const int file = ::open(made.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) throw std::runtime_error("cannot write " + name);
    try {
      tool::keep_owner_and_mode(file, replaced, name);
    } catch (...) {
      ::close(file);
      throw;
    }
    ::close(file);
  }
};

}  // namespace

const VectorFormats& gdal_formats() {
  static const GdalFormats formats;
  return formats;
}

std::string gdal_version() {
  return ::GDALVersionInfo("RELEASE_NAME");
}

}  // namespace polylidar::tool
