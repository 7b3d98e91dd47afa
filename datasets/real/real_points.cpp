#include "datasets/real/real_points.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string_view>
#include <utility>

#include "datasets/data_folder.hpp"
#include "polylidar/point_locator.hpp"

namespace hullbench::real {

namespace {

namespace fs = std::filesystem;
using polylidar::MultiPolygon;
using polylidar::Point;
using polylidar::PointLocator;
using polylidar::Ring;

constexpr const char* kCloudPackage = "libcgal-demo";

/// What dpkg knows of the packages of the system below `root`.
fs::path dpkg_folder(const fs::path& root) {
  return root / "var/lib/dpkg";
}

/// The first file of an installed package whose path ends so.
fs::path find_file(const std::string& package, const std::string& ending, const fs::path& root) {
  std::ifstream list(dpkg_folder(root) / "info" / (package + ".list"));
  for (std::string line; std::getline(list, line);) {
    if (line.ends_with(ending)) return root / line.substr(1);
  }
  throw std::runtime_error("the package " + package + " has no file " + ending.substr(1) +
                           "; install it anew");
}

/// As a word of the shell's.
std::string quoted(const std::string& word) {
  std::string result = "'";
  for (const char c : word) result += c == '\'' ? "'\\''" : std::string(1, c);
  return result + "'";
}

/// Words of an object's description: those of "data/b9.ply label=2".
std::string quoted_words(const std::string& text) {
  std::string result;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    result += " " + quoted(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return result;
}

std::string reader_command(const Source& source, const fs::path& root) {
  const fs::path scripts = data_folder() / "datasets" / "real";
  if (source.package == kCloudPackage) {
    return "python3 -B " + quoted((scripts / "read_cloud.py").string()) + " " +
           quoted(find_file(source.package, "/data.tar.gz", root).string()) + quoted_words(source.object);
  }
  // "spData" of Debian's r-cran-spdata: the names differ in their letters' case, which Debian's do not tell.
  const fs::path folder = find_file(source.package, "/DESCRIPTION", root).parent_path();
  return "Rscript --vanilla " + quoted((scripts / "read_r.R").string()) + " " + quoted(folder.string()) +
         " " + quoted(source.object);
}

/// The last line of `text` that has something in it.
std::string last_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

/// All that the command prints.
std::string output_of(const std::string& command, const std::string& what) {
  std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot start the reader of " + what);
  std::string text;
  std::array<char, 65536> buffer{};
  for (std::size_t count = 0; (count = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    text.append(buffer.data(), count);
  const int status = pclose(pipe);
  if (status == 0) return text;
  throw std::runtime_error("cannot read the points of " + what + ": " + last_line(std::move(text)));
}

Point parse_point(std::string_view text, std::string_view line) {
  const auto number = [&] {
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || !std::isfinite(value))
      throw std::runtime_error("the reader's line '" + std::string(line) + "' is no point");
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return value;
  };
  const double x = number();
  return {x, number()};
}

/// Clockwise rings are holes of the shell that they lie in.
MultiPolygon polygons_of(std::vector<Ring> rings) {
  MultiPolygon result;
  const auto first_hole = std::stable_partition(
      rings.begin(), rings.end(), [](const Ring& ring) { return polylidar::signed_area(ring) > 0; });
  for (auto ring = rings.begin(); ring != first_hole; ++ring) result.push_back({std::move(*ring), {}});
  for (auto hole = first_hole; hole != rings.end(); ++hole) {
    const auto around = std::find_if(result.begin(), result.end(), [&](const polylidar::Polygon& polygon) {
      return !hole->empty() && PointLocator({{polygon.shell, {}}}).contains(hole->front());
    });
    if (around == result.end()) throw std::runtime_error("the window has a hole that lies in no shell");
    around->holes.push_back(std::move(*hole));
  }
  return result;
}

}  // namespace

const Source* find_source(const std::string& name) {
  const auto found =
      std::find_if(sources().begin(), sources().end(), [&](const Source& one) { return one.name == name; });
  return found == sources().end() ? nullptr : &*found;
}

std::optional<std::string> installed_version(const std::string& package, const fs::path& root) {
  std::ifstream status(dpkg_folder(root) / "status");
  bool here = false;
  bool installed = false;
  const std::string version = "Version: ";
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("Package: ")) {
      here = line == "Package: " + package;
      installed = false;
    } else if (here && line.starts_with("Status: ")) {
      installed = line.ends_with(" installed");
    } else if (installed && line.starts_with(version)) {
      return line.substr(version.size());
    }
  }
  return std::nullopt;
}

std::string describe(const Source& source, const fs::path& root) {
  const auto version = installed_version(source.package, root);
  return "Debian's package " + source.package +
         (version ? " " + *version : std::string(", not installed (") + kInstallCommand + ")") + ": " +
         source.object;
}

Sample parse_sample(const std::string& text) {
  Sample sample;
  std::vector<Ring> rings;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = std::string_view(text).substr(begin, end - begin);
    if (line.starts_with("p ")) sample.points.push_back(parse_point(line.substr(2), line));
    if (line == "r") rings.emplace_back();
    if (line.starts_with("w ")) {
      if (rings.empty()) throw std::runtime_error("the window has a vertex before its first ring");
      rings.back().push_back(parse_point(line.substr(2), line));
    }
    begin = end + 1;
  }
  sample.window = polygons_of(std::move(rings));
  return sample;
}

Sample read_sample(const Source& source, const fs::path& root) {
  if (!installed_version(source.package, root)) {
    throw NotInstalled("the package " + source.package + ", which has the points, is not installed; '" +
                       kInstallCommand + "' installs it");
  }
  Sample sample = parse_sample(output_of(reader_command(source, root), source.name));
  if (sample.points.empty())
    throw std::runtime_error("the package " + source.package + " has no points of " + source.object);
  return sample;
}

std::string markdown() {
  std::string table = "| Data set | Points | Package | Object | Licence |\n|---|---|---|---|---|\n";
  for (const Source& source : sources()) {
    table += "| `" + source.name + "` | " + source.title + " | " + source.package + " | `" + source.object +
             "` | " + source.licence + " |\n";
  }
  return table;
}

}  // namespace hullbench::real
