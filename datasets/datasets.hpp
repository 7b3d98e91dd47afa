// The catalogue of data sets: by name, a shape and points of it.
//
// A data set is one shape from a file ("ca"), or a family whose members are shapes of one kind, numbered
// from 1 ("star-1" ... "star-9800"). Points are drawn from the shape, as many as are asked for, or come with
// it, as those of the floors, of degenerate.hpp, of the zoo and of real/ do. Behind a '~' stands how they are
// drawn where not uniformly ("ca~noise:0.5", "star-17~gradient:16~outliers:5"; see stress.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "datasets/point_stream.hpp"
#include "datasets/shapes.hpp"
#include "polylidar/geometry.hpp"

namespace hullbench {

/// Where data sets are read from.
struct DataFolders {
  DataFolders(std::filesystem::path shape_folder = default_data_directory(),
              std::filesystem::path recording_folder = {}, std::filesystem::path system_root = "/")
      : shapes(std::move(shape_folder)),
        recordings(std::move(recording_folder)),
        system(std::move(system_root)) {}

  std::filesystem::path shapes;      ///< with the manifest; see shapes.hpp
  std::filesystem::path recordings;  ///< of the user's, see rgbd/recordings.hpp; empty: there are none
  std::filesystem::path system;      ///< whose packages have the real points; see real/real_points.hpp
};

/// A data set as `hullbench list` shows it.
struct DatasetInfo {
  std::string name;    ///< as in plans and records: "ca", "star"
  std::string title;   ///< as printed in tables: "California"; of one member
  std::string source;  ///< who made the data
  std::string licence;
  std::string sha256 = {};  ///< of the shape's file, lower-case hex; empty when there is no single file
  /// Of the shape without holes, squared units of the points; none: a family, the zoo, or points without a
  /// shape.
  std::optional<double> area = {};
  bool has_holes_variant = false;
  std::size_t members = 0;  ///< of a family; 0: one shape
  bool own_points =
      false;  ///< the points come with the shape: neither a number nor a stress can be asked for
};

/// The families of floors: simulated, from above and from a low camera, and recorded where there is a folder
/// of recordings.
inline constexpr const char* kSimulatedFloor = "floor";
inline constexpr const char* kLowFloor = "lowfloor";
inline constexpr const char* kRecordedFloor = "recorded";

/// The user's recordings again, as points without a truth.
inline constexpr const char* kRealRecording = "real-recorded";

/// Whether `name` is of real points without a truth, which no table of errors may have.
bool is_real(const std::string& name);

/// The family and the number (from 1) in a member's name: {"star", 17} of "star-17"; none for other names.
std::optional<std::pair<std::string, std::size_t>> split_member_name(const std::string& name);

/// The shape that data set `name` is a variant of, for who must not take two variants for independent: "ca"
/// for "ca" and "ca~noise:0.5", "star-17" for "star-17~outliers:5", "channel" for "channel-4", since the
/// members of a family with a feature are one shape. Names that are not known are their own.
std::string base_shape(const std::string& name);

/// What a curve can be drawn against, by name: {"noise", 0.5} for "ca~noise:0.5", {"width", 4} for
/// "channel-4", both for "channel-4~noise:0.5", a level for each of several stresses; none for "ca". Units as
/// in stress.hpp; of a feature, spacings of 2000 points.
std::map<std::string, double> levels_of(const std::string& name);

/// Points and what they came from.
struct PointSet {
  std::vector<polylidar::Point> points;
  /// With its holes cut out when the variant with holes was asked for; empty: there is nothing to score
  /// against.
  polylidar::MultiPolygon ground_truth;
  double ground_truth_area = 0;  ///< squared units of the points
  /// In which real points were looked for; no truth, and empty where it is not known.
  polylidar::MultiPolygon window;
  std::string sha256;  ///< of point_bytes(points), lower-case hex: the record's dataset_sha256
};

/// Every data set: the shapes in the order of the manifest, then the families. Throws as read_manifest.
std::vector<DatasetInfo> datasets(const DataFolders& folders = {});

/// The entry of `infos` that `name` belongs to: of that name, or the family it is a member of; null when
/// there is none, for a family's own name, for a number that the family has not, and for a stress that there
/// is not or that is asked of a data set with points of its own.
const DatasetInfo* find_dataset(const std::vector<DatasetInfo>& infos, const std::string& name);

/// The ground truth of data set `name`, whatever its stress; `holes`: of its variant with holes, which is one
/// fixed shape (its seed is in the manifest or the family); empty of real points. Throws
/// std::invalid_argument, listing the known names, when there is no such data set or it has no such variant;
/// otherwise as load_shape, with_circular_holes and load_recording.
polylidar::MultiPolygon make_ground_truth(const std::string& name, bool holes,
                                          const DataFolders& folders = {});

/// `n` points in that ground truth, uniform or with the name's stresses, with everything a run needs to know
/// about them. Every combination of name without stress, holes, n and seed has a stream of random numbers of
/// its own, so samples of different sizes are independent, and those of different levels of a stress are not.
/// With n = 0 the data set's own points (own_points), where `seed` is that of the sensor's noise. Throws as
/// make_ground_truth, sample_uniform and the stress, std::invalid_argument for n = 0 where points have to be
/// drawn and for another n where they come with the shape, and real::NotInstalled for real points whose
/// package is not there.
PointSet make_point_set(const std::string& name, bool holes, std::size_t n, std::uint64_t seed,
                        const DataFolders& folders = {});

/// The points of make_point_set one after the other. Throws as make_point_set.
PointStream stream_points(const std::string& name, bool holes, std::size_t n, std::uint64_t seed,
                          const DataFolders& folders = {});

/// Whether stream_points takes no memory for points of `name` however many are asked for: they are uniform,
/// with or without lakes, noise, outliers and rounding. Also of data sets that come with their points.
bool is_streamed(const std::string& name);

}  // namespace hullbench
