// Data sets of GDAL, and what GDAL says of them.
#pragma once

#include <cpl_error.h>
#include <gdal.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace polylidar::tool {

/// Takes what GDAL has to say in this thread, so that it does not print it, and keeps the first error and the
/// warnings, each once.
class GdalErrors {
 public:
  GdalErrors() { CPLPushErrorHandlerEx(&GdalErrors::take, this); }
  ~GdalErrors() { CPLPopErrorHandler(); }
  GdalErrors(const GdalErrors&) = delete;
  GdalErrors& operator=(const GdalErrors&) = delete;

  bool any() const { return !first_.empty(); }
  /// ": what was said"; empty when nothing was.
  std::string said() const { return any() ? ": " + first_ : ""; }
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  static void CPL_STDCALL take(CPLErr kind, CPLErrorNum /*number*/, const char* said) {
    auto& errors = *static_cast<GdalErrors*>(CPLGetErrorHandlerUserData());
    std::string text = *said == '\0' ? "an error without a text" : said;
    std::replace(text.begin(), text.end(), '\n', ' ');
    if (kind >= CE_Failure && !errors.any()) errors.first_ = text;
    std::vector<std::string>& warnings = errors.warnings_;
    if (kind == CE_Warning && std::find(warnings.begin(), warnings.end(), text) == warnings.end())
      warnings.push_back(text);
  }

  std::string first_;
  std::vector<std::string> warnings_;
};

struct Close {
  void operator()(GDALDatasetH dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<void, Close>;

struct DestroyFeature {
  void operator()(OGRFeatureH feature) const { OGR_F_Destroy(feature); }
};
using Feature = std::unique_ptr<void, DestroyFeature>;

struct ReleaseSystem {
  void operator()(OGRSpatialReferenceH system) const { OSRRelease(system); }
};
using SpatialSystem = std::unique_ptr<void, ReleaseSystem>;

/// `kind`: GDAL_OF_VECTOR or GDAL_OF_RASTER. `drivers` and `options` end with a null.
inline Dataset open(const std::string& path, const char* const* drivers = nullptr,
                    const char* const* options = nullptr, unsigned kind = GDAL_OF_VECTOR) {
  return Dataset(
      GDALOpenEx(path.c_str(), kind | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR, drivers, options, nullptr));
}

inline std::vector<OGRLayerH> layers_of(GDALDatasetH dataset) {
  std::vector<OGRLayerH> layers;
  for (int i = 0; i < GDALDatasetGetLayerCount(dataset); ++i) {
    if (OGRLayerH layer = GDALDatasetGetLayer(dataset, i)) layers.push_back(layer);
  }
  return layers;
}

}  // namespace polylidar::tool
