// pictures.jsonl: what there is to see of a run: points, ground truth and every method's result, on a grid
// fine enough to be drawn and for nothing else. Figures and the HTML report are drawn from it; no score is.
//
//   {"kind": "case", "case": "ca/n:2000/holes:1", "dataset_sha256": "...", "origin": [x0, y0], "step": s,
//    "points_total": 2000, "points": [i, j, i, j, ...], "ground_truth": POLYGONS}
//   {"kind": "result", "case": "ca/n:2000/holes:1", "run": "polylidar/ca/n:2000/holes:1/protocol:paper",
//    "id": "...", "output_sha256": "...", "l2": 0.05, "polygons": POLYGONS}
//
// POLYGONS is a list of polygons, each its shell and then its holes, each ring a flat list of grid
// coordinates [i, j, i, j, ...] that stand for (x0 + s i, y0 + s j), the first vertex not repeated. The
// schema is results/picture.schema.json.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/record/json_lines.hpp"
#include "benchmarks/record/record.hpp"
#include "datasets/datasets.hpp"

namespace hullbench::record {

inline constexpr const char* kPicturesFile = "pictures.jsonl";

/// The case in a run's name: "ca/n:2000/holes:1" of "polylidar/ca/n:2000/holes:1/protocol:paper".
std::string case_of_run(const std::string& run_name);

/// Writes the pictures of one run's folder. Of a plan of at most kAllPictures runs every result is kept. Of a
/// larger one the worst kWorstPictures of each method and protocol, shape family, stress and kind of holes by
/// l2, an invalid result being the worst: a line is written when a result is among them so far, so the file
/// holds somewhat more.
class PictureBook {
 public:
  static constexpr std::size_t kAllPictures = 1000;
  static constexpr std::size_t kWorstPictures = 12;
  /// Of a case's points so many are kept, at even distances in their order.
  static constexpr std::size_t kMostPoints = 4000;

  /// Goes on with the file in `folder`, or begins it. `planned_runs`: of the whole run. Throws
  /// std::runtime_error naming the file when it cannot be written or holds something else.
  PictureBook(const fs::path& folder, std::size_t planned_runs);

  /// Writes `result`, and its case when that is not there yet, unless it is not to be kept; a coordinate that
  /// is not finite or too far away for the grid cannot be drawn, and such a result is left out.
  void add(const RunRecord& record, const PointSet& set, const MultiPolygon& result);

 private:
  /// Whether a result with that error is among the worst of its group so far.
  bool is_wanted(const std::string& group, double error) const;
  /// That it is kept.
  void remember(const std::string& group, double error);

  bool keep_all_;
  std::set<std::string> cases_;                         ///< that have their line
  std::map<std::string, std::multiset<double>> worst_;  ///< errors that are kept, by group
  JsonLinesWriter writer_;
};

/// Puts the pictures of the runs in `folders` together in `out`: each case once, of several results of a run
/// the first. Folders without pictures are passed over. Throws std::runtime_error naming a file that cannot
/// be read or written.
void merge_pictures(const std::vector<fs::path>& folders, const fs::path& out);

}  // namespace hullbench::record
