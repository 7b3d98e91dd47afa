// Real points that come without a truth: point patterns and laser scans in packages of Debian. They are read
// from the package that is installed and never kept here. README.md lists them.
#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "polylidar/geometry.hpp"

namespace hullbench::real {

/// The command that installs every package of sources().
inline constexpr const char* kInstallCommand = "make deps-real";

/// One set of points.
struct Source {
  std::string name;     ///< of the data set: "real-clmfires"
  std::string title;    ///< what the points are, as printed in tables
  std::string package;  ///< of Debian, which brings them: "r-cran-spatstat.data"
  std::string object;   ///< of an R package, what read_r.R is told; else what read_cloud.py is
  std::string licence;  ///< as the package says
};

/// All of them, package by package.
const std::vector<Source>& sources();

/// The source of that name; null when there is none.
const Source* find_source(const std::string& name);

/// The version of Debian's package that is installed in the system whose files stand below `root`; none when
/// it is not, or when the system does not say.
std::optional<std::string> installed_version(const std::string& package, const std::filesystem::path& root);

/// Where the points come from, in words: package, version, object; or that the package is not installed.
std::string describe(const Source& source, const std::filesystem::path& root);

/// Says which package is not installed, and the command that installs it.
class NotInstalled : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Points, in the package's own unit, and the window in which they were looked for: not their shape, and
/// empty where none is known.
struct Sample {
  std::vector<polylidar::Point> points;
  polylidar::MultiPolygon window;
};

/// What the reader has printed: lines "p X Y" (a point), "r" (a ring of the window begins) and "w X Y" (its
/// next vertex); others are passed over. A ring that runs clockwise is a hole of the shell around it. Throws
/// std::runtime_error for numbers that are none or not finite, a vertex before the first ring, and a hole
/// without a shell.
Sample parse_sample(const std::string& text);

/// The points of `source` in the system below `root`, in the package's order. Throws NotInstalled, and
/// std::runtime_error with what the reader said when it fails.
Sample read_sample(const Source& source, const std::filesystem::path& root);

/// The sources as a table in Markdown, a row a set: the part of README.md between its marks.
std::string markdown();

}  // namespace hullbench::real
