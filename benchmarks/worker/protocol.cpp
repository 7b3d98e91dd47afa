#include "benchmarks/worker/protocol.hpp"

#include <bit>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <system_error>

#include "benchmarks/base/names.hpp"
#include "benchmarks/base/number_format.hpp"

namespace hullbench::worker {
namespace {

static_assert(std::endian::native == std::endian::little,
              "points files are little-endian and copied as they are");
static_assert(sizeof(Point) == 2 * sizeof(double), "a point is two doubles without padding");

/// A number; `none` for null.
double number_from_json(const json& value, double none = std::numeric_limits<double>::infinity()) {
  if (value.is_null()) return none;
  if (!value.is_number()) throw std::invalid_argument("a number or null was expected, not " + value.dump());
  return value.get<double>();
}

json parameter_to_json(const ParameterInfo& parameter) {
  json result = {{"name", parameter.name},
                 {"unit", parameter.unit},
                 {"description", parameter.description},
                 {"minimum", finite_or_null(parameter.minimum)},
                 {"maximum", finite_or_null(parameter.maximum)}};
  if (parameter.default_value) result["default"] = finite_or_null(*parameter.default_value);
  return result;
}

ParameterInfo parameter_from_json(const json& source) {
  ParameterInfo parameter;
  source.at("name").get_to(parameter.name);
  source.at("unit").get_to(parameter.unit);
  source.at("description").get_to(parameter.description);
  parameter.minimum = number_from_json(source.at("minimum"), -std::numeric_limits<double>::infinity());
  parameter.maximum = number_from_json(source.at("maximum"));
  if (source.contains("default")) parameter.default_value = number_from_json(source.at("default"));
  return parameter;
}

[[noreturn]] void throw_cannot(const char* what, const fs::path& path, int error) {
  throw std::runtime_error("cannot " + std::string(what) + " " + path.string() + ": " +
                           std::generic_category().message(error));
}

}  // namespace

json method_to_json(const MethodInfo& info) {
  json parameters = json::array();
  for (const ParameterInfo& parameter : info.parameters) parameters.push_back(parameter_to_json(parameter));
  json capabilities = {{"holes", info.capabilities.holes},
                       {"several_polygons", info.capabilities.several_polygons}};
  // Only where it is so: a worker that does not know of it need not say it.
  if (info.capabilities.in_server) capabilities["in_server"] = true;
  return {{"name", info.name},        {"title", info.title},         {"version", info.version},
          {"licence", info.licence},  {"citation", info.citation},   {"native_output", info.native_output},
          {"parameters", parameters}, {"capabilities", capabilities}};
}

MethodInfo method_from_json(const json& source) {
  MethodInfo info;
  source.at("name").get_to(info.name);
  source.at("title").get_to(info.title);
  source.at("version").get_to(info.version);
  source.at("licence").get_to(info.licence);
  source.at("citation").get_to(info.citation);
  source.at("native_output").get_to(info.native_output);
  for (const json& parameter : source.at("parameters"))
    info.parameters.push_back(parameter_from_json(parameter));
  source.at("capabilities").at("holes").get_to(info.capabilities.holes);
  source.at("capabilities").at("several_polygons").get_to(info.capabilities.several_polygons);
  info.capabilities.in_server = source.at("capabilities").value("in_server", false);
  return info;
}

void write_points_file(const fs::path& path, std::span<const Point> points) {
  std::vector<std::uint8_t> bytes(points.size_bytes());
  if (!bytes.empty()) std::memcpy(bytes.data(), points.data(), bytes.size());
  write_bytes(path, bytes);
}

std::vector<Point> read_points_file(const fs::path& path, std::size_t n) {
  const std::vector<std::uint8_t> bytes = read_bytes(path, std::numeric_limits<std::size_t>::max());
  if (bytes.size() / sizeof(Point) != n || bytes.size() % sizeof(Point) != 0) {
    throw std::runtime_error(path.string() + " holds " + std::to_string(bytes.size()) +
                             " bytes, which is not " + std::to_string(n) + " points");
  }
  std::vector<Point> points(n);
  if (n > 0) std::memcpy(points.data(), bytes.data(), bytes.size());
  return points;
}

std::vector<std::uint8_t> read_bytes(const fs::path& path, std::size_t max_bytes) {
  if (!fs::is_regular_file(path)) throw std::runtime_error("there is no file " + path.string());
  const std::uintmax_t size = fs::file_size(path);
  if (size > max_bytes) {
    throw std::runtime_error(path.string() + " has " + std::to_string(size) + " bytes, more than the " +
                             std::to_string(max_bytes) + " that are allowed");
  }
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!in) throw_cannot("read", path, errno);
  return bytes;
}

void write_bytes(const fs::path& path, std::span<const std::uint8_t> bytes) {
  errno = 0;
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) throw_cannot("write", path, errno);
}

std::string printable(std::string_view text, std::size_t max_size) {
  if (text.size() > max_size) text = text.substr(text.size() - max_size);
  std::string result(text);
  for (char& character : result) {
    const auto code = static_cast<unsigned char>(character);
    if (code < 0x20 || code == 0x7F) character = ' ';
    if (code > 0x7F) character = '?';
  }
  const auto first = result.find_first_not_of(' ');
  if (first == std::string::npos) return {};
  return result.substr(first, result.find_last_not_of(' ') - first + 1);
}

}  // namespace hullbench::worker
