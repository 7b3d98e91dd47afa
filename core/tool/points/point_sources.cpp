#include "tool/points/point_sources.hpp"

#include <memory>
#include <optional>

#include "tool/points/kept_points.hpp"
#include "tool/points/readers.hpp"

namespace polylidar::tool {
namespace {

using point_files::KeptPoints;

/// One part of a file, which is read again each time until its points are kept.
class FileSource {
 public:
  FileSource(std::string path, PointFileOptions options, std::uint64_t most_kept_bytes, OnRead on_read)
      : path_(std::move(path)),
        options_(std::move(options)),
        on_read_(std::move(on_read)),
        kept_(most_kept_bytes) {}

  void give(const TakePoints& take) {
    if (kept_.is_whole()) {
      kept_.hand_on(take, point_files::points_in_block(options_));
    } else {
      options_.take_points = take;
      options_.keep = &kept_;
      file_ = read_point_file(path_, options_);
    }
    on_read_(options_.part.number, file_);
  }

 private:
  std::string path_;
  PointFileOptions options_;
  OnRead on_read_;
  KeptPoints kept_;
  PointFile file_;  ///< without its points
};

}  // namespace

std::vector<std::uint64_t> kept_bytes(std::span<const std::string> paths, const PointFileOptions& options,
                                      std::uint64_t most) {
  if (paths.size() == 1) return {most};
  std::vector<std::uint64_t> shares;
  for (const std::string& path : paths) {
    const std::optional<ExpectedPoints> expected = expected_points(path, options);
    const bool has_room = expected && expected->count <= most / sizeof(point_files::LatticePoint);
    shares.push_back(has_room ? expected->count * sizeof(point_files::LatticePoint) : 0);
    most -= shares.back();
  }
  return shares;
}

std::vector<PointSource> point_sources(const std::string& path, const PointFileOptions& options,
                                       std::size_t most_parts, std::uint64_t most_kept_bytes,
                                       const OnRead& on_read) {
  const std::size_t count = most_parts > 1 && is_read_in_parts(path, options) ? most_parts : 1;
  std::vector<PointSource> sources;
  for (std::size_t number = 0; number < count; ++number) {
    PointFileOptions of_part = options;
    of_part.part = {number, count};
    const auto source = std::make_shared<FileSource>(path, of_part, most_kept_bytes / count, on_read);
    sources.emplace_back([source](const TakePoints& take) { source->give(take); });
  }
  return sources;
}

}  // namespace polylidar::tool
