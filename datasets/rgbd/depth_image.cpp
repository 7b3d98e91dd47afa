#include "datasets/rgbd/depth_image.hpp"

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "datasets/json_file.hpp"

namespace hullbench {

using nlohmann::json;

namespace {

/// Far above any camera, and low enough for width * height to stay far inside 64 bits.
constexpr int kMaxSide = 65535;

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& member,
                         const std::string& wanted) {
  throw std::runtime_error(path.string() + " is not a camera's intrinsics: \"" + member +
                           "\" is missing or out of range; give " + wanted);
}

int read_side(const json& document, const std::filesystem::path& path, const char* member) {
  const auto found = document.find(member);
  const bool usable = found != document.end() && found->is_number_integer() &&
                      found->get<std::int64_t>() >= 1 && found->get<std::int64_t>() <= kMaxSide;
  if (!usable) refuse(path, member, "the image's " + std::string(member) + " in pixels, 1 to 65535");
  return found->get<int>();
}

double read_number(const json& document, const std::filesystem::path& path, const char* member) {
  const auto found = document.find(member);
  if (found == document.end() || !found->is_number()) refuse(path, member, "a number");
  return found->get<double>();
}

double read_positive(const json& document, const std::filesystem::path& path, const char* member,
                     const std::string& wanted) {
  const auto found = document.find(member);
  const bool usable = found != document.end() && found->is_number() && found->get<double>() > 0;
  if (!usable) refuse(path, member, wanted);
  return found->get<double>();
}

}  // namespace

Vector3 pixel_ray(const Intrinsics& intrinsics, double u, double v) {
  return {(u - intrinsics.ppx) / intrinsics.fx, (v - intrinsics.ppy) / intrinsics.fy, 1};
}

Intrinsics read_intrinsics(const std::filesystem::path& path) {
  const json document = read_json_file(path);
  if (!document.is_object()) {
    throw std::runtime_error(path.string() +
                             " is not a camera's intrinsics: it is not a JSON object; give one with width, "
                             "height, fx, fy, ppx, ppy and depth_unit");
  }
  const std::string focal = "the focal length in pixels, above 0";
  return {.width = read_side(document, path, "width"),
          .height = read_side(document, path, "height"),
          .fx = read_positive(document, path, "fx", focal),
          .fy = read_positive(document, path, "fy", focal),
          .ppx = read_number(document, path, "ppx"),
          .ppy = read_number(document, path, "ppy"),
          .depth_unit = read_positive(document, path, "depth_unit", "the metres a count, above 0")};
}

}  // namespace hullbench
