#include "tool/gdal/layer_content.hpp"

#include <algorithm>
#include <cmath>

namespace polylidar::tool {
namespace {

void add_bounds(OGRGeometryH geometry, std::optional<Box>& bounds) {
  OGREnvelope box;
  OGR_G_GetEnvelope(geometry, &box);
  if (!bounds) bounds = Box{{box.MinX, box.MinY}, {box.MaxX, box.MaxY}};
  bounds->min = {std::min(bounds->min.x, box.MinX), std::min(bounds->min.y, box.MinY)};
  bounds->max = {std::max(bounds->max.x, box.MaxX), std::max(bounds->max.y, box.MaxY)};
}

void add_layer(OGRLayerH layer, LayerContent& content) {
  OGRFeatureDefnH fields = OGR_L_GetLayerDefn(layer);
  const int label = OGR_FD_GetFieldIndex(fields, "label");
  const bool is_text = label >= 0 && OGR_Fld_GetType(OGR_FD_GetFieldDefn(fields, label)) == OFTString;
  if (is_text && !content.labels) content.labels.emplace();
  if (OGRSpatialReferenceH system = OGR_L_GetSpatialRef(layer)) content.system.reset(OSRClone(system));
  OGR_L_ResetReading(layer);
  while (const Feature feature{OGR_L_GetNextFeature(layer)}) {
    OGRGeometryH geometry = OGR_F_GetGeometryRef(feature.get());
    if (geometry == nullptr || OGR_G_IsEmpty(geometry) != 0) continue;
    add_bounds(geometry, content.bounds);
    if (is_text) content.labels->insert(OGR_F_GetFieldAsString(feature.get(), label));
  }
}

}  // namespace

LayerContent content_of(GDALDatasetH dataset) {
  LayerContent content;
  for (OGRLayerH layer : layers_of(dataset)) add_layer(layer, content);
  return content;
}

std::optional<std::string> changed_label(const LayerContent& source, const LayerContent& written) {
  if (!source.labels || !written.labels) return {};
  for (const std::string& label : *source.labels) {
    if (!written.labels->contains(label)) return label;
  }
  return {};
}

std::optional<std::string> other_system(const LayerContent& source, OGRSpatialReferenceH system,
                                        const LayerContent& written) {
  if (!source.bounds || !written.bounds || system == nullptr || !written.system) return {};
  if (OSRIsSame(system, written.system.get()) != 0) return {};
  // A datum's shift is a ten-thousandth of a coordinate, what formats round is less than a millionth.
  constexpr double kRounding = 1e-6;
  const auto differs = [](double a, double b) {
    return std::abs(a - b) > kRounding * std::max(std::abs(a), std::abs(b));
  };
  const Box& a = *source.bounds;
  const Box& b = *written.bounds;
  const bool is_moved = differs(a.min.x, b.min.x) || differs(a.min.y, b.min.y) || differs(a.max.x, b.max.x) ||
                        differs(a.max.y, b.max.y);
  if (!is_moved) return {};
  return OSRGetName(written.system.get());
}

}  // namespace polylidar::tool
