// What a concave-hull method must offer to be measured: the one interface between the harness and a method.
//
// An adapter only translates between this interface and its library. It reads no clock, no file and no ground
// truth, and it chooses no parameter.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "polylidar/geometry.hpp"

namespace hullbench {

using polylidar::MultiPolygon;
using polylidar::Point;
using polylidar::Polygon;
using polylidar::Ring;

/// One parameter of a method. Values are numbers; a switch is 0 or 1.
struct ParameterInfo {
  std::string name;         ///< as in plans and records: snake_case
  std::string unit;         ///< "length", "length^2", "ratio", "count" (a whole number), "switch", "1"
  std::string description;  ///< one sentence
  double minimum = 0;       ///< smallest legal value, inclusive
  double maximum = 0;       ///< largest legal value, inclusive; infinity when there is none
  /// What the method does when the parameter is absent; none: required. Infinity above `maximum` is legal and
  /// means that the parameter is not given.
  std::optional<double> default_value;
};

/// A limit on a length, of 0 or more. Without a default it is required; infinity: no limit.
ParameterInfo length_limit(std::string name, std::string description, std::optional<double> default_value);
/// 0 or 1, and 0 when absent.
ParameterInfo off_switch(std::string name, std::string description);

/// What a method's result can be; a table of methods is made from these.
struct Capabilities {
  bool holes = false;             ///< a polygon may have holes
  bool several_polygons = false;  ///< the result may have more than one polygon
  /// The work is done in another process, such as a database server: the worker's memory tells nothing of it.
  bool in_server = false;
};

/// Who a method is. Everything here is fixed for the life of the adapter object.
struct MethodInfo {
  std::string name;           ///< identifier: snake_case
  std::string title;          ///< as printed in tables: "CGAL alpha shape"
  std::string version;        ///< of the library that runs, asked of it at run time
  std::string licence;        ///< SPDX expression of the library that runs
  std::string citation;       ///< where the method is described
  std::string native_output;  ///< what the library itself returns, e.g. "unordered set of edges"
  std::vector<ParameterInfo> parameters;
  Capabilities capabilities;
};

/// Parameter values by name, complete or with defaults left out.
using Parameters = std::map<std::string, double>;

/// Where a method that can tell its inner steps names them. The caller owns the clock: a step lasts from its
/// `begin` to the next `begin` or to the end of the phase. Usual names: "triangulation", "shape", "polygon".
class Steps {
 public:
  virtual ~Steps() = default;
  virtual void begin(std::string_view name) = 0;
};

/// For a caller to whom the steps do not matter.
class NoSteps final : public Steps {
 public:
  void begin(std::string_view /*name*/) override {}
};

/// The method cannot run here because something is not installed or not reachable. `what()` says what;
/// `remedy()` is the command (or the setting) that helps.
class NotInstalled : public std::runtime_error {
 public:
  NotInstalled(const std::string& what, std::string remedy)
      : std::runtime_error(what), remedy_(std::move(remedy)) {}
  const std::string& remedy() const { return remedy_; }

 private:
  std::string remedy_;
};

/// The method cannot do what was asked (not an error of the method): e.g. this many points.
class Unsupported : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A concave-hull method. Calls come in the order info, then any number of (load, then any number of
/// (run, extract)); from one thread. A parameter that is unknown or out of range, or a point that is not
/// finite, is std::invalid_argument; any other exception means that the method failed. What every method does
/// alike is done here; a method fills in `info_` and the functions that begin with `do_`.
class Adapter {
 public:
  virtual ~Adapter() = default;
  Adapter() = default;
  Adapter(const Adapter&) = delete;
  Adapter& operator=(const Adapter&) = delete;

  const MethodInfo& info() const { return info_; }

  /// Puts `points` into the method's own types (or its database). Not part of the headline time.
  void load(std::span<const Point> points);

  /// Runs the method from scratch on the loaded points. This is what the paper timed. Nothing may be kept
  /// from an earlier run except memory.
  void run(const Parameters& parameters, Steps& steps);

  /// Turns the result of the last run into rings: shells counter-clockwise, holes clockwise, first vertex not
  /// repeated. Together with `run` this is the headline time. Throws std::logic_error when there is no
  /// result.
  MultiPolygon extract(Steps& steps);

  /// Drops the result of the last run. The caller does this between repetitions, off the clock, so that no
  /// run pays for freeing what its predecessor left. The loaded points stay.
  void reset();

 protected:
  /// Whether some three of the loaded points are not on one line, so that a hull with an area exists.
  bool has_area() const { return has_area_; }

  MethodInfo info_;

 private:
  /// All of `points` are finite.
  virtual void do_load(std::span<const Point> points) = 0;
  /// `parameters` are complete and in their ranges; no result is there.
  virtual void do_run(const Parameters& parameters, Steps& steps) = 0;
  virtual MultiPolygon do_extract(Steps& steps) = 0;
  virtual void do_reset() {}

  bool has_area_ = false;
  bool has_run_ = false;
};

/// `parameters` with defaults filled in. Throws std::invalid_argument naming the first parameter that is
/// unknown, missing without a default, NaN or out of its range.
Parameters complete_parameters(const MethodInfo& info, const Parameters& parameters);

/// Whether the method can run without any parameter: each has a default, and none's says that it is not
/// given.
bool has_defaults(const MethodInfo& info);

/// A method that this build knows, whether or not it can run here.
struct AdapterEntry {
  std::string name;
  std::string title;
  /// Makes the adapter; throws NotInstalled when the library or server is missing.
  std::function<std::unique_ptr<Adapter>()> make;
  /// The first 8 digits of the SHA-256 of its sources in this project: adapter, headers, what it links that
  /// is built here. Empty where `make` throws NotInstalled, as nothing was built.
  std::string sources = {};
};

/// All methods known to this build, in the order of the tables.
const std::vector<AdapterEntry>& adapter_registry();

/// The one of them that has this name, or null.
const AdapterEntry* find_adapter(std::string_view name);

}  // namespace hullbench
