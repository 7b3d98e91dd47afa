#include "benchmarks/run/run_directory.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/files.hpp"
#include "benchmarks/record/kept_polygons.hpp"
#include "benchmarks/record/pictures.hpp"
#include "benchmarks/record/stored_run.hpp"

namespace hullbench::run {
namespace {

constexpr const char* kRepetitionsFile = "repetitions.jsonl";
constexpr const char* kScratchFolder = "scratch";

/// run.json of a folder; null when it has none that can be read.
json read_header(const fs::path& folder) {
  std::ifstream in(folder / record::kHeaderFile, std::ios::binary);
  json header = in ? json::parse(in, nullptr, false) : json();
  return header.is_object() ? header : json();
}

void remove_run_files(const fs::path& folder) {
  for (const char* file : {record::kHeaderFile, record::kRowsFile, kRepetitionsFile, record::kPicturesFile,
                           record::kReportFile, record::kTablesFile, record::kSuiteFile}) {
    fs::remove(folder / file);
  }
  fs::remove_all(folder / record::kTablesFolder);
  fs::remove_all(folder / record::kPolygonsFolder);
}

/// Whether nothing is in the folder but what a start leaves that was killed before it wrote run.json.
bool holds_no_run_yet(const fs::path& folder) {
  const bool has_rows = fs::exists(folder / record::kRowsFile);  // made before the scratch folder
  return std::all_of(
      fs::directory_iterator(folder), fs::directory_iterator(), [=](const fs::directory_entry& entry) {
        const fs::path name = entry.path().filename();
        return (name == kScratchFolder && has_rows) ||
               ((name == record::kRowsFile || name == kRepetitionsFile || name == record::kPicturesFile) &&
                entry.file_size() == 0);
      });
}

/// The folders in `runs` by name, which begins with the time, the last one first.
std::vector<fs::path> newest_first(const fs::path& runs) {
  std::vector<fs::path> folders;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(runs, ignored)) folders.push_back(entry.path());
  std::sort(folders.rbegin(), folders.rend());
  return folders;
}

bool holds_run(const fs::path& folder, const json& header) {
  const json earlier = read_header(folder);
  return earlier.is_object() && run_continuity(earlier) == run_continuity(header);
}

std::unique_ptr<RunDirectory> open_chosen(const json& header, const fs::path& folder, bool force) {
  make_writable_folder(folder);
  if (!force && !holds_run(folder, header) && !holds_no_run_yet(folder)) {
    const bool is_run = read_header(folder).is_object();
    if (!is_run && fs::exists(folder / record::kRowsFile)) {
      throw ConfigurationError(
          "the output folder " + folder.string() + " has measured rows, but its " + record::kHeaderFile +
          " cannot be read; put that back, or choose another folder with --out: --force would "
          "delete the rows");
    }
    throw ConfigurationError("the output folder " + folder.string() + " holds " +
                             (is_run ? "another run" : "something else than a run") +
                             "; choose another one with --out, or overwrite it with --force");
  }
  const int lock = lock_or_throw(folder);
  if (force) remove_run_files(folder);
  return std::make_unique<RunDirectory>(folder, lock);
}

/// The newest earlier run that is the same, when it is not finished and nobody is at it.
std::unique_ptr<RunDirectory> open_unfinished(const json& header, const fs::path& runs) {
  const auto is_same = [&](const fs::path& folder) { return holds_run(folder, header); };
  const auto folder = find_unfinished(runs, is_same, record::kReportFile);
  const int lock = folder ? try_lock(*folder) : -1;
  return lock < 0 ? nullptr : std::make_unique<RunDirectory>(*folder, lock);
}

/// "20260131T120000Z-<machine>-<commit>", from the header's own words.
std::string folder_name(const json& header) {
  std::string time = header.at("created").get<std::string>();
  std::erase_if(time, [](char c) { return c == '-' || c == ':'; });
  const json& commit = header.at("tool").at("commit");
  return time + "-" + header.at("environment").at("machine_id").get<std::string>() + "-" +
         (commit.is_string() ? commit.get<std::string>().substr(0, 7) : "nocommit");
}

Repetition repetition_from_json(const json& line) {
  Repetition repetition;
  line.at("time_ns").get_to(repetition.time_ns);
  line.at("phases_ns").get_to(repetition.phases_ns);
  line.at("output_sha256").get_to(repetition.output_sha256);
  line.at("round").get_to(repetition.round);
  line.at("pass").get_to(repetition.pass);
  if (const auto canary = line.find("canary_ns"); canary != line.end())
    repetition.canary_ns = canary->get<record::CanaryTimes>();
  repetition.remeasured = line.value("remeasured", false);
  repetition.unsteady = line.value("unsteady", false);
  return repetition;
}

}  // namespace

RunDirectory::RunDirectory(const fs::path& path, int lock)
    : RowStore({path, record::kRowsFile, kScratchFolder, &record::RunRecord::name}, lock),
      header_(read_header(path)) {
  repetition_writer_.emplace(path / kRepetitionsFile);
  read_repetitions();
}

void RunDirectory::write_header(const json& header) {
  write_json_file(path() / record::kHeaderFile, header);
  header_ = header;
}

void RunDirectory::read_repetitions() {
  for (const json& line : record::load_json_lines(path() / kRepetitionsFile).lines) {
    try {
      auto& known = repetitions_[line.at("id").get<std::string>()];
      // Out of order can only be what two harnesses wrote; the lock excludes that.
      if (line.at("repetition").get<std::size_t>() == known.size())
        known.push_back(repetition_from_json(line));
    } catch (const json::exception&) {
      throw ConfigurationError("a line of " + (path() / kRepetitionsFile).string() +
                               " is not a repetition; start anew with --force or another --out");
    }
  }
}

const std::vector<Repetition>& RunDirectory::repetitions(const std::string& id) const {
  static const std::vector<Repetition> none;
  const auto found = repetitions_.find(id);
  return found == repetitions_.end() ? none : found->second;
}

void RunDirectory::append_repetition(const std::string& id, std::size_t index, const Repetition& repetition) {
  json line = {{"id", id},
               {"repetition", index},
               {"time_ns", repetition.time_ns},
               {"phases_ns", repetition.phases_ns},
               {"output_sha256", repetition.output_sha256},
               {"round", repetition.round},
               {"pass", repetition.pass}};
  if (repetition.canary_ns) line["canary_ns"] = *repetition.canary_ns;
  if (repetition.remeasured) line["remeasured"] = true;
  if (repetition.unsteady) line["unsteady"] = true;
  repetition_writer_->append(line);
  repetitions_[id].push_back(repetition);
}

json run_continuity(const json& header) {
  const auto member = [](const json& object, const char* key) {
    return object.is_object() && object.contains(key) ? object[key] : json();
  };
  return {member(header, "schema_version"),
          member(header, "plan"),
          member(header, "manifests"),
          member(header, "filter"),
          member(member(header, "tool"), "binary_sha256"),
          member(member(header, "environment"), "machine_id"),
          member(header, "shard"),
          member(header, "merged")};
}

void remove_stale_scratch(const fs::path& results) {
  std::error_code ignored;
  const auto remove_in = [&](const fs::path& run) {
    // What has a folder of that name and is no run is not ours.
    if (!fs::is_directory(run / kScratchFolder, ignored) || !fs::exists(run / record::kRowsFile, ignored))
      return;
    const int lock = ::open(run.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (lock >= 0 && ::flock(lock, LOCK_EX | LOCK_NB) == 0) fs::remove_all(run / kScratchFolder, ignored);
    if (lock >= 0) ::close(lock);
  };
  for (const fs::path& folder : newest_first(results / "runs")) {
    remove_in(folder);
    for (const fs::path& member : newest_first(folder)) remove_in(member);
  }
}

bool is_finished_run(const fs::path& folder, const json& header) {
  return holds_run(folder, header) && fs::exists(folder / record::kReportFile);
}

std::optional<fs::path> find_unfinished(const fs::path& runs,
                                        const std::function<bool(const fs::path&)>& is_same,
                                        const char* mark) {
  const std::vector<fs::path> folders = newest_first(runs);
  const auto newest = std::ranges::find_if(folders, is_same);
  if (newest == folders.end() || fs::exists(*newest / mark)) return std::nullopt;
  return *newest;
}

fs::path make_run_folder(const json& header, const fs::path& results) {
  const fs::path runs = results / "runs";
  make_writable_folder(runs);
  const std::string name = folder_name(header);
  // Two runs may begin in the same second.
  for (int count = 1; count < 1000; ++count) {
    fs::path folder = runs / (count == 1 ? name : name + "-" + std::to_string(count));
    std::error_code error;
    const bool made = fs::create_directory(folder, error);
    if (error) throw not_writable(runs, error.message());
    if (made) return folder;
  }
  throw not_writable(runs, "too many runs began in this second");
}

std::unique_ptr<RunDirectory> open_run_directory(const json& header, const RunPlace& place) {
  if (place.out) return open_chosen(header, *place.out, place.force);
  if (!place.force) {
    if (auto unfinished = open_unfinished(header, place.results / "runs")) return unfinished;
  }
  const fs::path folder = make_run_folder(header, place.results);
  return std::make_unique<RunDirectory>(folder, lock_or_throw(folder));
}

void point_latest_to(const fs::path& run_directory, const fs::path& results) {
  // Made beside it and renamed over it, so that there is a link at every moment.
  const fs::path link = results / "latest";
  const fs::path temporary = results / "latest.new";
  std::error_code error;
  fs::remove(temporary, error);
  fs::create_directory_symlink(fs::path("runs") / run_directory.filename(), temporary, error);
  if (!error) fs::rename(temporary, link, error);
  if (error)
    throw std::runtime_error("cannot let " + link.string() + " point to the run: " + error.message());
}

}  // namespace hullbench::run
