#include "benchmarks/run/contract.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>

#include "adapters/wkb.hpp"
#include "benchmarks/metrics/area.hpp"
#include "benchmarks/metrics/shape_measures.hpp"
#include "benchmarks/metrics/validity.hpp"
#include "datasets/random.hpp"

namespace hullbench::run {
namespace {

constexpr std::size_t kPoints = 500;
/// Coordinates are multiples of this, so that moving and scaling by powers of two rounds nothing.
constexpr double kGrid = 0x1p-24;
/// Two shapes are the same when the area in which they differ is at most this share of theirs: far above the
/// rounding of overlays, far below a triangle of the samples.
constexpr double kSameShare = 1e-9;
constexpr std::chrono::milliseconds kQuitPatience{10'000};
/// A method that hangs would do so at every point.
constexpr int kMostTimeouts = 2;

/// `count` points in [0, 1) x [0, 1), those within `hole` of the middle left out.
std::vector<Point> sample(std::size_t count, std::uint64_t seed, double hole = 0) {
  Random random(seed);
  std::vector<Point> points;
  points.reserve(count);
  while (points.size() < count) {
    const Point point = {std::floor(random.uniform() / kGrid) * kGrid,
                         std::floor(random.uniform() / kGrid) * kGrid};
    if (std::hypot(point.x - 0.5, point.y - 0.5) >= hole) points.push_back(point);
  }
  return points;
}

std::vector<Point> moved(std::vector<Point> points, double scale, Point by) {
  for (Point& point : points) point = {point.x * scale + by.x, point.y * scale + by.y};
  return points;
}

MultiPolygon moved(MultiPolygon shape, double scale, Point by) {
  for (Polygon& polygon : shape) {
    polygon.shell = moved(std::move(polygon.shell), scale, by);
    for (Ring& hole : polygon.holes) hole = moved(std::move(hole), scale, by);
  }
  return shape;
}

std::vector<Point> joined(std::vector<Point> a, const std::vector<Point>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::vector<Point> shuffled(std::vector<Point> points) {
  Random random(99);
  for (std::size_t i = points.size(); i > 1; --i) std::swap(points[i - 1], points[random.below(i)]);
  return points;
}

std::string plural(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string describe(const MultiPolygon& shape) {
  if (shape.empty()) return "an empty shape";
  return plural(shape.size(), "polygon") + ", " + plural(metrics::count_holes(shape), "hole");
}

/// For points that lie `spacing` apart on average (in their unit) and a method of which nothing else is
/// known: lengths are three spacings, squared lengths nine of them squared, everything else is at its
/// default, or in the middle of its range when it has none, or at 0 when that has no ends; all clamped to
/// their ranges.
Parameters contract_parameters(const MethodInfo& info, double spacing) {
  constexpr double kSpacings = 3;
  Parameters result;
  for (const ParameterInfo& parameter : info.parameters) {
    double value = kSpacings * spacing;
    if (parameter.unit == "length^2") value *= value;
    if (parameter.unit != "length" && parameter.unit != "length^2") {
      const double middle = std::isfinite(parameter.maximum) ? (parameter.minimum + parameter.maximum) / 2
                                                             : parameter.minimum + 1;
      value = parameter.default_value.value_or(std::isfinite(middle) ? middle : 0);
    }
    const bool is_default = value == parameter.default_value;
    result[parameter.name] = is_default ? value : std::clamp(value, parameter.minimum, parameter.maximum);
  }
  return result;
}

/// What a run gave: a shape, or why there is none.
struct Result {
  record::Status status = record::Status::kOk;
  std::string fault;  ///< empty when there is a shape that keeps what every shape must
  MultiPolygon shape;
  std::vector<std::uint8_t> wkb;
  std::chrono::nanoseconds elapsed{0};

  /// In words, which for some points is as good as an empty shape; a method that breaks is not.
  bool refused() const { return status == record::Status::kUnsupported || status == record::Status::kError; }
};

/// Ends a test that would only wait.
struct TooManyTimeouts {};

class ContractTest {
 public:
  ContractTest(const worker::Method& method, const ContractLimits& limits, fs::path scratch,
               const std::function<void(const Verdict&)>& say)
      : session_(method, limits.worker), limits_(limits), scratch_(std::move(scratch)), say_(say) {}

  std::vector<Verdict> run() {
    if (!start()) return verdicts_;
    try {
      square();
      without_area();
      three_points();
      duplicates();
      not_a_number();
      two_clusters();
      ring();
      repeat();
      order();
      place_and_scale();
      limits();
      quit();
    } catch (const TooManyTimeouts&) {
    }
    return verdicts_;
  }

 private:
  void add(const std::string& name, bool kept, const std::string& words,
           record::Status status = record::Status::kOk) {
    verdicts_.push_back({name, kept, status, words});
    say_(verdicts_.back());
  }

  /// Kept when there is no fault.
  void add(const std::string& name, const std::string& fault, const std::string& seen) {
    add(name, fault.empty(), fault.empty() ? seen : fault);
  }

  bool start() {
    session_.begin_start();
    session_.finish_start();
    if (session_.info()) {
      add("start", true, "version " + session_.info()->version);
      return true;
    }
    const worker::Reply& reply = session_.start_reply();
    add("start", false, to_string(reply.status) + ": " + reply.detail + advice(reply), reply.status);
    return false;
  }

  /// What helps a worker that does not start. One that ends before its first word may lack a package, of
  /// which only its interpreter knows.
  std::string advice(const worker::Reply& reply) const {
    if (!reply.remedy.empty()) return "; remedy: " + reply.remedy;
    const worker::Method& method = session_.method();
    std::string text = "; see adapters/process/PROTOCOL.md for the answer to hello";
    if (method.install.empty()) return text;
    return text + "; it was started by '" + method.command.front() +
           "', and what it needs is installed by '" + method.install + "'";
  }

  Result hull(const std::vector<Point>& points, double spacing) {
    if (timeouts_ == kMostTimeouts) throw TooManyTimeouts();
    const worker::LoadedPoints loaded =
        worker::write_points("contract-" + std::to_string(++loads_), points, scratch_);
    const worker::Attempt attempt =
        session_.run(loaded, contract_parameters(*session_.info(), spacing), scratch_, limits_.timeout);
    Result result;
    result.status = attempt.status;
    result.wkb = attempt.wkb;
    result.elapsed = attempt.elapsed;
    if (attempt.status == record::Status::kTimeout) ++timeouts_;
    if (attempt.status != record::Status::kOk) {
      result.fault = to_string(attempt.status) + ": " + attempt.detail;
      return result;
    }
    try {
      result.shape = from_wkb(attempt.wkb);
      result.fault = fault_of(result.shape, points);
    } catch (const std::exception& error) {
      result.fault = std::string("the result is no WKB polygon (") + error.what() + "): write closed rings";
    }
    return result;
  }

  /// What no shape of any method may have.
  std::string fault_of(const MultiPolygon& shape, const std::vector<Point>& points) const {
    if (const std::string reason = metrics::invalid_reason(shape); !reason.empty()) {
      return "invalid polygon, " + reason + ": return polygons that are valid in the sense of the OGC";
    }
    const Capabilities& can = session_.info()->capabilities;
    if (!can.holes && metrics::count_holes(shape) > 0) {
      return "a hole, which the method says it cannot have: say so in its capabilities";
    }
    if (!can.several_polygons && shape.size() > 1) {
      return "several polygons, which the method says it cannot have: say so in its capabilities";
    }
    // Points that are not finite have no hull.
    if (!std::ranges::all_of(points, [](const Point& p) { return std::isfinite(p.x) && std::isfinite(p.y); }))
      return {};
    const double largest = metrics::convex_hull_area(points);
    if (polylidar::area(shape) > largest * (1 + kSameShare)) {
      return "a shape larger than the points' convex hull: return polygons whose vertices are the points";
    }
    return {};
  }

  /// Why `a` and `b` are not the same shape; empty when they are.
  static std::string difference(const MultiPolygon& a, const MultiPolygon& b) {
    if (a.empty() && b.empty()) return {};
    if (a.empty() || b.empty()) return "one shape is empty and the other is not";
    const metrics::AreaScores scores = metrics::area_scores(a, b);
    if (scores.l2 && *scores.l2 <= kSameShare) return {};
    std::ostringstream share;
    share << *scores.l2 * 100;
    return "the shapes differ in " + share.str() + " % of their area";
  }

  /// The shape of the points that everything is compared with.
  const Result& reference() {
    if (!reference_) reference_ = hull(sample(kPoints, 1), spacing_of(kPoints));
    return *reference_;
  }

  static double spacing_of(std::size_t count) { return 1 / std::sqrt(static_cast<double>(count)); }

  void square() {
    const Result& result = reference();
    std::string fault = result.fault;
    if (fault.empty() && result.shape.empty()) fault = "an empty shape of 500 points: return their hull";
    add("a square of points", fault, describe(result.shape));
  }

  void without_area() {
    std::vector<Point> line;
    line.reserve(20);
    for (int i = 0; i < 20; ++i) line.push_back({i * 0.25, i * 0.5});
    const std::vector<std::pair<std::string, std::vector<Point>>> inputs = {
        {"no point", {}},
        {"one point", {{0.5, 0.25}}},
        {"two points", {{0, 0}, {1, 0.5}}},
        {"points on a line", line},
        {"one point, 20 times", std::vector<Point>(20, Point{0.5, 0.25})}};
    for (const auto& [name, points] : inputs) {
      const Result result = hull(points, 0.25);
      const bool empty = result.fault.empty() && result.shape.empty();
      std::string words = empty ? "an empty shape" : "refused, " + result.fault;
      if (!empty && !result.refused()) words = result.fault.empty() ? "a polygon" : result.fault;
      if (result.status == record::Status::kOk && !empty) {
        words += "; return no polygon for points without an area, or refuse them as 'unsupported'";
      }
      add(name, empty || result.refused(), words);
    }
  }

  void three_points() {
    const Result result = hull({{0, 0}, {1, 0}, {0, 1}}, 1);
    add("three points", result.fault.empty() || result.refused(),
        result.fault.empty() ? describe(result.shape) : result.fault);
  }

  void duplicates() {
    const std::vector<Point> points = sample(kPoints, 1);
    same_as_reference("every point twice", hull(joined(points, points), spacing_of(kPoints)), 1, {0, 0},
                      "leave out points that are there already");
  }

  void not_a_number() {
    for (const auto& [name, value] :
         {std::pair{"a point that is not a number", std::nan("")},
          std::pair{"a point at infinity", std::numeric_limits<double>::infinity()}}) {
      std::vector<Point> points = sample(100, 2);
      points[50].y = value;
      const Result result = hull(points, spacing_of(100));
      add(name, result.refused(),
          result.refused() ? "refused, " + result.fault
                           : (result.fault.empty() ? describe(result.shape) : result.fault) +
                                 "; refuse it in 'load' as 'invalid_argument'");
    }
  }

  void two_clusters() {
    const std::vector<Point> points = sample(kPoints / 2, 3);
    const Result result = hull(joined(points, moved(points, 1, {1024, 512})), spacing_of(kPoints / 2));
    add("two clusters far apart", result.fault, describe(result.shape));
  }

  void ring() {
    const Result result = hull(sample(kPoints, 4, 0.35), spacing_of(kPoints));
    add("a ring with a hole", result.fault, describe(result.shape));
  }

  void repeat() {
    const Result first = reference();
    hull(sample(kPoints, 5, 0.2), spacing_of(kPoints));
    const Result again = hull(sample(kPoints, 1), spacing_of(kPoints));
    std::string fault = again.fault;
    if (fault.empty() && again.wkb != first.wkb) {
      fault =
          "other bytes for the same points: start every run from nothing, with random numbers from a fixed "
          "seed";
    }
    add("the same points again", fault, "the same bytes");
  }

  void same_as_reference(const std::string& name, const Result& result, double scale, Point by,
                         const std::string& remedy) {
    const Result& first = reference();
    std::string fault = !result.fault.empty() ? result.fault : first.fault;
    if (fault.empty()) {
      try {
        fault = difference(result.shape, moved(first.shape, scale, by));
      } catch (const std::runtime_error& error) {  // rounding may make the moved shape invalid
        fault = std::string("the shapes cannot be compared: ") + error.what();
      }
      if (!fault.empty()) fault += ": " + remedy;
    }
    add(name, fault, "the same shape");
  }

  void order() {
    same_as_reference("the points in another order", hull(shuffled(sample(kPoints, 1)), spacing_of(kPoints)),
                      1, {0, 0}, "let nothing depend on the order of the points");
  }

  void place_and_scale() {
    const std::vector<Point> points = sample(kPoints, 1);
    const Point far = {4096, -2048};
    same_as_reference("the points elsewhere", hull(moved(points, 1, far), spacing_of(kPoints)), 1, far,
                      "let nothing depend on where the origin is");
    for (const auto& [name, scale] : {std::pair{"the points 1024 times larger", 1024.0},
                                      std::pair{"the points 1024 times smaller", 0x1p-10}}) {
      same_as_reference(
          name, hull(moved(points, scale, {0, 0}), scale * spacing_of(kPoints)), scale, {0, 0},
          "let nothing depend on the unit of the points, and say by the units of the parameters "
          "which of them are lengths");
    }
  }

  void limits() {
    const Result result = hull(sample(limits_.many_points, 6), spacing_of(limits_.many_points));
    std::ostringstream seen;
    seen << describe(result.shape) << ", after " << std::setprecision(2)
         << std::chrono::duration<double>(result.elapsed).count() << " s";
    add(std::to_string(limits_.many_points) + " points within the limits", result.fault, seen.str());
  }

  void quit() {
    const bool ended = session_.quit(kQuitPatience);
    add("the end", ended,
        ended ? "the worker ends when it is told to" : "the worker had to be killed: let it end on 'quit'");
  }

  worker::MethodSession session_;
  ContractLimits limits_;
  fs::path scratch_;
  const std::function<void(const Verdict&)>& say_;
  std::vector<Verdict> verdicts_;
  std::optional<Result> reference_;
  int loads_ = 0;
  int timeouts_ = 0;
};

}  // namespace

std::vector<Verdict> test_contract(const worker::Method& method, const ContractLimits& limits,
                                   const fs::path& scratch, const std::function<void(const Verdict&)>& say) {
  return ContractTest(method, limits, scratch, say).run();
}

}  // namespace hullbench::run
