// Real recordings of floors: a folder with one sub-folder a scene, in the layout of the paper's published
// data.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "datasets/rgbd/floor_scenes.hpp"

namespace hullbench {

/// The names of the sub-folders of `folder` that hold a points.txt or a depth.png, sorted. Throws
/// std::runtime_error naming the folder and what to do when it is none or has no such sub-folder.
std::vector<std::string> list_recordings(const std::filesystem::path& folder);

/// The scene in the folder `scene`. Its ground truth is gt.geojson, in metres, as read_geojson takes it. Its
/// points are points.txt when there is one, else floor_points of depth.png with intrinsics.json.
///
/// points.txt has a point a line: two or three numbers, separated by blanks or a comma each. The points are
/// in the frame of the ground truth already, so a third number is a height over the floor and is dropped.
/// Empty lines and lines that begin with # are skipped.
///
/// Throws std::runtime_error naming the file, the line and what to do when a file is missing or is not as
/// described, a number is not finite, or there are fewer than 3 points; otherwise as read_geojson,
/// read_intrinsics, read_depth_png and floor_points.
FloorScene load_recording(const std::filesystem::path& scene);

/// The points of the scene alone, which needs no gt.geojson for them. Throws as load_recording for what it
/// reads.
std::vector<polylidar::Point> recorded_points(const std::filesystem::path& scene);

}  // namespace hullbench
