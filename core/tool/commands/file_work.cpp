#include "tool/commands/file_work.hpp"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <new>
#include <optional>
#include <set>
#include <system_error>
#include <thread>
#include <utility>

#include "tool/points/point_file.hpp"
#include "tool/points/point_sources.hpp"
#include "tool/program/configuration_error.hpp"
#include "tool/program/interrupt.hpp"

namespace polylidar::tool {

void MemoryGate::enter(std::uint64_t bytes) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return taken_ == 0 || taken_ + bytes <= budget_; });
  taken_ += bytes;
}

void MemoryGate::leave(std::uint64_t bytes) {
  {
    const std::lock_guard lock(mutex_);
    taken_ -= bytes;
  }
  changed_.notify_all();
}

void MemoryShare::take(std::uint64_t bytes) {
  gate_.leave(std::exchange(bytes_, 0));
  gate_.enter(bytes);
  bytes_ = bytes;
}

namespace {

/// promised_points(), but no more than can be counted with, whatever a header says.
std::optional<std::uint64_t> possible_points(const std::string& path) {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 40U;
  const std::optional<std::uint64_t> points = promised_points(path);
  return points ? std::optional(std::min(*points, kMost)) : std::nullopt;
}

}  // namespace

std::uint64_t unpacked_size(const std::string& path) {
  constexpr std::uint64_t kTextInGzip = 8;       // of coordinates with many digits it is 3
  constexpr std::uint64_t kLeastLasRecord = 20;  // bytes of a point
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) return 0;
  // LAZ packs to a fifth or less.
  if (const auto points = possible_points(path)) return std::max(size, kLeastLasRecord * *points);
  return size * (path.ends_with(".gz") ? kTextInGzip : 1);
}

std::uint64_t memory_to_triangulate(const std::string& path) {
  constexpr std::uint64_t kOfByteOfText = kBytesOfPoint / 25;    // ten digits and a separator, twice
  constexpr std::uint64_t kOfByteOfNumbers = kBytesOfPoint / 8;  // two floats; of doubles it is half of that
  if (const auto points = possible_points(path)) return kBytesOfPoint * *points;
  return unpacked_size(path) * (names_binary(path) ? kOfByteOfNumbers : kOfByteOfText);
}

std::uint64_t memory_to_stream(const std::string& path) {
  // Measured: 22 MB for a million points of a survey, 72 for ten and 180 for forty, of 20 bytes in the file;
  // and what of them is kept.
  return map_bytes_to_stream(path) + std::min(unpacked_size(path) / 2, kMostKeptBytes);
}

std::uint64_t map_bytes_to_stream(const std::string& path) {
  constexpr std::uint64_t kAtLeast = std::uint64_t{1} << 24U;
  return kAtLeast + unpacked_size(path) / 4;
}

void check_each_once(const std::vector<std::string>& paths) {
  std::set<std::filesystem::path> seen;
  for (const std::string& path : paths) {
    std::error_code error;
    const std::filesystem::path whole = std::filesystem::canonical(path, error);
    if (!error && !seen.insert(whole).second) {
      throw ConfigurationError(path + " is given twice; give each file once");
    }
  }
}

void check_readable_again(const std::vector<std::string>& paths, const std::string& option) {
  for (const std::string& path : paths) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    const bool is_stream = std::filesystem::is_fifo(status) || std::filesystem::is_character_file(status) ||
                           std::filesystem::is_socket(status);
    if (path != "-" && (error || !is_stream)) continue;
    throw ConfigurationError(option + " does not go with " + (path == "-" ? "standard input" : path) +
                             ", which can be read once only; give a file");
  }
}

FileWork::FileWork(const std::vector<std::string>& paths, const Surroundings& surroundings,
                   StatusLine& status)
    : paths_(paths), surroundings_(surroundings), status_(status), outcomes_(paths.size()) {
  check_each_once(paths);
}

std::string FileWork::tried() const {
  return std::to_string(tried_) + " of " + std::to_string(paths_.size()) + " files";
}

void FileWork::show(std::size_t file, const std::string& doing) {
  throw_if_interrupted();
  status_.show(tried() + "; " + std::filesystem::path(paths_[file]).filename().string() + ": " + doing);
}

void FileWork::run(unsigned threads, std::uint64_t memory, const Work& work) {
  const auto count = static_cast<unsigned>(std::min<std::size_t>(threads, paths_.size()));
  MemoryGate gate(memory);
  std::atomic<std::size_t> next = 0;
  const auto take_files = [&] {
    for (std::size_t file = next++; file < paths_.size() && !interrupted(); file = next++) {
      MemoryShare share(gate);
      // Threads that no other file can use.
      work_on(file, std::max(1U, threads / count), share, work);
      ++tried_;
      status_.show(tried());
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (unsigned t = 1; t < count; ++t) helpers.emplace_back(take_files);
    take_files();
  }
  status_.clear();
  throw_if_interrupted();
  for (const Outcome& outcome : outcomes_) {
    if (!outcome.is_done) surroundings_.err << surroundings_.program << ": " << outcome.failure << "\n";
  }
  if (std::none_of(outcomes_.begin(), outcomes_.end(), [](const Outcome& o) { return o.is_done; })) {
    throw ConfigurationError("none of the files could be read, so nothing is written");
  }
}

void FileWork::work_on(std::size_t file, unsigned threads, MemoryShare& memory, const Work& work) {
  Outcome& outcome = outcomes_[file];
  const std::string& path = paths_[file];
  try {
    outcome.crs = work(file, threads, memory);
    outcome.is_done = true;
  } catch (const Interrupted&) {
    // The flag is set, and everybody sees it.
  } catch (const PointFileError& error) {
    outcome.failure = error.what();
  } catch (const std::bad_alloc&) {
    outcome.failure = path + ": there is not enough memory for its points";
  } catch (const std::exception& error) {
    outcome.failure = path + ": " + error.what();
  }
}

std::optional<Crs> FileWork::common_crs() const {
  std::optional<Crs> common;
  for (const Outcome& outcome : outcomes_) {
    if (!outcome.is_done) continue;
    if (common && *common != outcome.crs) return {};
    common = outcome.crs;
  }
  return common.value_or(Crs());
}

std::string FileWork::systems() const {
  std::vector<std::pair<const Crs*, std::vector<std::string>>> systems;  // in the order of their first files
  for (std::size_t file = 0; file < outcomes_.size(); ++file) {
    if (!outcomes_[file].is_done) continue;
    const auto same = std::find_if(systems.begin(), systems.end(),
                                   [&](const auto& system) { return *system.first == outcomes_[file].crs; });
    (same == systems.end() ? systems.emplace_back(&outcomes_[file].crs, std::vector<std::string>()) : *same)
        .second.push_back(paths_[file]);
  }
  std::string text;
  for (const auto& [crs, files] : systems) {
    const std::string name = !crs->name().empty() ? crs->name()
                             : crs->is_given      ? "one without a number"
                                                  : "none";
    text += (text.empty() ? "" : ", ") + name + " (" + files[0];
    if (files.size() > 1) text += " and " + std::to_string(files.size() - 1) + " more";
    text += ")";
  }
  return text;
}

ExitCode FileWork::summary(const std::string& result) const {
  const std::size_t count = outcomes_.size();
  const auto failed = static_cast<std::size_t>(
      std::count_if(outcomes_.begin(), outcomes_.end(), [](const Outcome& o) { return !o.is_done; }));
  surroundings_.err << surroundings_.program << ": " << count - failed << " of " << count
                    << (count == 1 ? " file is" : " files are") << " in " << result
                    << (failed > 0 ? ", " + std::to_string(failed) + " could not be read" : std::string())
                    << "\n";
  return failed > 0 ? kExitFailures : kExitOk;
}

}  // namespace polylidar::tool
