#include "benchmarks/run/merge.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/plan/plan.hpp"
#include "benchmarks/record/pictures.hpp"
#include "benchmarks/record/stored_run.hpp"
#include "benchmarks/run/run_directory.hpp"
#include "benchmarks/run/runner.hpp"

namespace hullbench::run {
namespace {

/// A run that is merged into another one.
struct Source {
  fs::path folder;
  json run;  ///< as load_run gives it
};

Source load_source(const fs::path& folder) {
  if (!fs::exists(folder / "run.json"))
    throw ConfigurationError("there is no run in " + folder.string() + "; give the folder of a run or suite");
  try {
    record::check_run(folder);
    return {folder, record::load_run(folder)};
  } catch (const ConfigurationError& error) {
    throw ConfigurationError(std::string("cannot merge: ") + error.what());
  }
}

/// What orders runs and parts of merged ones, whatever their order on the command line is: the time at which
/// they began, which has whole seconds only, then their shard and machine.
auto begin_of(const json& run) {
  return std::make_tuple(run.at("created"), run.value("shard", json()), run.at("environment"));
}

/// A merged run stands where its first part does, so that merging in turn gives what merging at once gives.
auto begin_of(const Source& source) {
  return begin_of(source.run.contains("merged") ? source.run["merged"].front() : source.run);
}

std::vector<Source> load_sources(const std::vector<fs::path>& folders) {
  std::vector<Source> sources;
  sources.reserve(folders.size());
  for (const fs::path& folder : folders) sources.push_back(load_source(folder));
  std::ranges::sort(sources, [](const Source& a, const Source& b) {
    const auto begin_a = begin_of(a);
    const auto begin_b = begin_of(b);
    return begin_a != begin_b ? begin_a < begin_b : a.run.at("runs") < b.run.at("runs");
  });
  return sources;
}

/// A value in a sentence, in brackets; nothing when it is too long for one.
std::string in_brackets(const json& one, const json& other) {
  const std::string text = " (" + one.dump() + " and " + other.dump() + ")";
  return text.size() <= 60 ? text : "";
}

/// An empty filter is written in two ways.
json filter_of(const json& run) {
  const json filter = run.value("filter", json());
  return filter == json("") ? json() : filter;
}

void require_agreement(const Source& one, const Source& other) {
  const auto require = [&](const std::string& what, const json& ours, const json& theirs) {
    if (ours == theirs) return;
    throw ConfigurationError(one.folder.string() + " and " + other.folder.string() + " differ in their " +
                             what + in_brackets(ours, theirs) + "; only runs of the same plan can be merged");
  };
  json ours = one.run.at("plan");
  json theirs = other.run.at("plan");
  require("plan's name", ours.value("name", ""), theirs.value("name", ""));
  ours.update(theirs);
  for (const auto& [key, unused] : ours.items()) {
    require("plan's " + key, one.run.at("plan").value(key, json()), theirs.value(key, json()));
  }
  require("seed", one.run.at("seed"), other.run.at("seed"));
  require("filter", filter_of(one.run), filter_of(other.run));
  require("scores, of which some were worked out anew", one.run.value("rescored", json()).is_null(),
          other.run.value("rescored", json()).is_null());
}

/// Throws when a name stands for different things in `sources`: a data set or a rule of parameters.
void require_same_definitions(const std::vector<Source>& sources) {
  std::map<std::string, std::pair<json, fs::path>> known;
  const auto add = [&](const std::string& what, const json& definition, const fs::path& folder) {
    const auto [first, is_new] = known.emplace(what, std::pair(definition, folder));
    if (is_new || first->second.first == definition) return;
    throw ConfigurationError(first->second.second.string() + " and " + folder.string() + " have another " +
                             what + " each; only runs on the same data with the same rules can be merged");
  };
  for (const Source& source : sources) {
    for (const json& dataset : source.run.at("datasets")) {
      add("data set " + dataset.at("name").get<std::string>(),
          {dataset.at("sha256"), dataset.at("source"), dataset.at("area")}, source.folder);
    }
    const json rules = source.run.value("rules", json::object());
    for (const auto& [name, formula] : rules.items()) add("rule " + name, formula, source.folder);
  }
}

/// Which version of each method is in the runs, and where it was met first.
class Versions {
 public:
  void add(const std::string& method, const std::string& version, const fs::path& folder) {
    if (version.empty()) return;
    const auto [known, is_new] = known_.emplace(method, std::pair(version, folder));
    if (is_new || known->second.first == version) return;
    throw ConfigurationError(method + " is of version " + known->second.first + " in " +
                             known->second.second.string() + " and of version " + version + " in " +
                             folder.string() +
                             ", which no table may mix; measure both with the same version");
  }

 private:
  std::map<std::string, std::pair<std::string, fs::path>> known_;
};

/// Less is better.
int rank(const record::RunRecord& row) {
  if (row.status == record::Status::kOk) return 0;
  return row.status == record::Status::kNotInstalled ? 2 : 1;
}

/// What two measurements of the same run agree in: its metrics but the memory, which is never twice the same.
json repeatable_metrics(const record::RunRecord& row) {
  json metrics = row.metrics;
  metrics.erase("peak_memory_bytes");
  return metrics;
}

/// The rows of several runs by name.
class Rows {
 public:
  void add(record::RunRecord row, const fs::path& folder) {
    const auto [found, is_new] = chosen_.try_emplace(row.name, row, folder);
    if (is_new) return;
    auto& [known, its_folder] = found->second;
    // A method that is not steady may fail with one result here and another one there.
    const bool both_are_ok = known.status == record::Status::kOk && row.status == record::Status::kOk;
    if (both_are_ok && (known.id != row.id || known.output_sha256 != row.output_sha256 ||
                        repeatable_metrics(known) != repeatable_metrics(row))) {
      throw std::runtime_error("the run " + row.name + " has another result in " + folder.string() +
                               " than in " + its_folder.string() +
                               "; find out which is right before they are merged");
    }
    repeated_.insert(row.name);
    if (rank(row) < rank(known)) found->second = {std::move(row), folder};
  }

  /// Those of `runs` that are there, in their order.
  std::vector<record::RunRecord> in_order(const std::vector<plan::PlannedRun>& runs) const {
    std::vector<record::RunRecord> result;
    for (const plan::PlannedRun& run : runs) {
      if (const auto found = chosen_.find(run.name); found != chosen_.end())
        result.push_back(found->second.first);
    }
    return result;
  }

  std::size_t size() const { return chosen_.size(); }
  const std::set<std::string>& repeated() const { return repeated_; }

 private:
  std::map<std::string, std::pair<record::RunRecord, fs::path>> chosen_;
  std::set<std::string> repeated_;
};

Rows gather_rows(const std::vector<Source>& sources) {
  Versions versions;
  Rows rows;
  for (const Source& source : sources) {
    for (const json& method : source.run.at("methods"))
      versions.add(method.at("name").get<std::string>(), method.at("version").get<std::string>(),
                   source.folder);
    for (const json& line : source.run.at("runs")) {
      record::RunRecord row = line.get<record::RunRecord>();
      versions.add(row.method, row.method_version, source.folder);
      if (row.machine.empty()) row.machine = source.run.at("environment").at("machine_id").get<std::string>();
      rows.add(std::move(row), source.folder);
    }
  }
  return rows;
}

/// The descriptions of `what` ("datasets", "methods") in all sources by name; of a method that is installed
/// somewhere the one from there.
std::map<std::string, json> descriptions(const std::vector<Source>& sources, const char* what) {
  std::map<std::string, json> result;
  for (const Source& source : sources) {
    for (const json& entry : source.run.at(what)) {
      json& known = result[entry.at("name").get<std::string>()];
      if (known.is_null() || (entry.value("installed", false) && !known.value("installed", false)))
        known = entry;
    }
  }
  return result;
}

json merged_datasets(const std::vector<Source>& sources) {
  std::vector<std::vector<std::string>> lists;
  for (const Source& source : sources) {
    auto& list = lists.emplace_back();
    for (const json& dataset : source.run.at("datasets"))
      list.push_back(dataset.at("name").get<std::string>());
  }
  const auto all = descriptions(sources, "datasets");
  json result = json::array();
  for (const std::string& name : common_order(lists)) result.push_back(all.at(name));
  return result;
}

/// In the order in which the plan's runs need them, like those of a run.
json merged_methods(const std::vector<Source>& sources, const plan::Plan& plan,
                    const std::vector<plan::PlannedRun>& runs) {
  std::map<std::string, json> all = descriptions(sources, "methods");
  json result = json::array();
  for (const plan::PlannedRun& run : runs) {
    const auto found = all.find(plan.methods[run.method_index].method);
    if (found == all.end()) continue;
    result.push_back(found->second);
    all.erase(found);
  }
  return result;
}

/// Where the rows came from: a run that is merged already tells it of its own parts.
json merged_from(const std::vector<Source>& sources) {
  json result = json::array();
  for (const Source& source : sources) {
    const json& run = source.run;
    if (run.contains("merged")) {
      for (const json& part : run["merged"]) result.push_back(part);
      continue;
    }
    result.push_back({{"shard", run.value("shard", json())},
                      {"created", run.at("created")},
                      {"resumed", run.value("resumed", json::array())},
                      {"tool", run.at("tool")},
                      {"environment", run.at("environment")}});
  }
  std::sort(result.begin(), result.end(),
            [](const json& a, const json& b) { return begin_of(a) < begin_of(b); });
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

json merge_notes(const std::vector<Source>& sources, const Rows& rows, std::size_t planned) {
  std::set<std::string> notes;
  for (const Source& source : sources) {
    // What an earlier merge says of missing rows may not be true any more.
    const bool is_merged = source.run.contains("merged");
    for (const json& note : source.run.at("notes")) {
      if (!is_merged || note == record::kTornNote) notes.insert(note.get<std::string>());
    }
  }
  json result = notes;
  if (rows.size() < planned) {
    result.push_back(std::to_string(planned - rows.size()) + " of " + std::to_string(planned) +
                     " planned runs are missing: they were not measured, or not in what was merged.");
  }
  if (!rows.repeated().empty()) {
    result.push_back(
        "Of the merged runs " + std::to_string(rows.repeated().size()) +
        " were measured more than once, with the same result where they succeeded; the first that "
        "did counts. One of them: " +
        *rows.repeated().begin() + ".");
  }
  return result;
}

}  // namespace

std::vector<std::string> common_order(std::vector<std::vector<std::string>> lists) {
  // The longest first: what a shard lacks, its list cannot put in its place.
  std::ranges::sort(
      lists, [](const auto& a, const auto& b) { return a.size() != b.size() ? a.size() > b.size() : a < b; });
  std::vector<std::string> result;
  for (const auto& list : lists) {
    // A new name goes behind the one that it follows in its list.
    auto place = result.begin();
    for (const std::string& name : list) {
      const auto known = std::ranges::find(result, name);
      place = (known == result.end() ? result.insert(place, name) : known) + 1;
    }
  }
  return result;
}

MergedRun merge_runs(const std::vector<fs::path>& folders) {
  const std::vector<Source> sources = load_sources(folders);
  const Source& first = sources.front();
  for (const Source& other : sources) require_agreement(first, other);
  require_same_definitions(sources);
  const plan::Plan plan = plan::parse_plan(first.run.at("plan").dump(), (first.folder / "run.json").string());
  const json filter = filter_of(first.run);
  const std::vector<plan::PlannedRun> runs =
      plan::planned_runs(plan, filter.is_string() ? filter.get<std::string>() : "");
  const Rows rows = gather_rows(sources);
  MergedRun result = {first.run, rows.in_order(runs), runs.size(), {}};
  for (const Source& source : sources) result.folders.push_back(source.folder);
  if (result.rows.size() != rows.size())
    throw std::runtime_error("a row of " + first.folder.string() +
                             " or what is merged with it is not of its plan");
  result.header.erase("runs");
  result.header["methods"] = merged_methods(sources, plan, runs);
  result.header["datasets"] = merged_datasets(sources);
  result.header["merged"] = merged_from(sources);
  result.header["notes"] = merge_notes(sources, rows, runs.size());
  result.header["shard"] = nullptr;
  result.header["resumed"] = json::array();
  return result;
}

}  // namespace hullbench::run
