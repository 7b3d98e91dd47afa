#include "benchmarks/gate/gate_probes.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/names.hpp"
#include "benchmarks/worker/worker_process.hpp"

namespace hullbench::gate {
namespace {

using namespace std::chrono_literals;
using Nanoseconds = std::vector<std::int64_t>;

constexpr auto kTimeout = 60s;
constexpr auto kCountingTimeout = 300s;
constexpr auto kQuitPatience = 10s;

std::vector<std::string> probe_command(const fs::path& program, const ProbeSettings& settings) {
  std::vector<std::string> command = {program.string(), settings.cases_folder.string(), "--repeats",
                                      std::to_string(settings.repeats)};
  for (const GateCase& entry : settings.cases) {
    if (entry.once) command.insert(command.end(), {"--once", entry.name});
    command.push_back(entry.name);
  }
  return command;
}

json answer_of(const std::vector<std::string>& command, const ProbeSettings& settings,
               std::chrono::milliseconds timeout) {
  worker::WorkerProcess process(command, {.memory_mib = 0, .core = settings.core});
  const worker::Reply reply = process.request({{"request", "measure"}}, timeout);
  if (reply.status != record::Status::kOk) {
    throw std::runtime_error("the probe " + command.front() + " failed: " + reply.detail);
  }
  process.quit(kQuitPatience);
  return reply.body;
}

double least(const Nanoseconds& times) {
  if (times.empty()) throw std::runtime_error("a probe gave no times");
  return static_cast<double>(*std::ranges::min_element(times));
}

/// Number of instructions in the file that callgrind dumped at the end of a call.
double dumped_count(const fs::path& path) {
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("totals: ")) continue;
    const double count = std::stod(line.substr(8));
    if (count > 0) return count;
  }
  throw std::runtime_error("callgrind counted nothing in " + path.string());
}

bool is_in_path(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (::access((fs::path(folder) / program).c_str(), X_OK) == 0) return true;
  }
  return false;
}

}  // namespace

ProbeTimes run_probe(const fs::path& program, const ProbeSettings& settings) {
  const json answer = answer_of(probe_command(program, settings), settings, kTimeout);
  ProbeTimes times;
  for (const GateCase& entry : settings.cases) {
    const json& measured = answer.at(entry.name);
    auto whole = measured.at("triangulation").get<Nanoseconds>();
    const auto outline = measured.at("outline").get<Nanoseconds>();
    if (whole.size() != outline.size()) throw std::runtime_error("a probe's steps differ in number");
    for (std::size_t i = 0; i < whole.size(); ++i) whole[i] += outline[i];
    times.ns["concave_hull " + entry.name] = least(whole);
    times.ns["outline " + entry.name] = least(outline);
    if (entry.once) {
      times.ns["concave_hull_once " + entry.name] =
          least(measured.at("concave_hull_once").get<Nanoseconds>());
    }
    times.results[entry.name] = measured.at("result").get<std::string>();
  }
  return times;
}

void write_results(const fs::path& program, const ProbeSettings& settings, const fs::path& folder) {
  fs::create_directories(folder);
  std::vector<std::string> command = probe_command(program, settings);
  command.insert(command.end(), {"--results", folder.string()});
  answer_of(command, settings, kTimeout);
}

std::map<std::string, double> count_instructions(const fs::path& program, const ProbeSettings& settings,
                                                 const fs::path& folder) {
  if (!is_in_path("valgrind")) {
    throw ConfigurationError("valgrind is not installed: 'apt-get install valgrind', then try again");
  }
  fs::remove_all(folder);
  fs::create_directories(folder);
  const std::string out = (folder / "count").string();
  // Counting is on inside that function only, and each call of it ends with a dump of its own: OUT.1, OUT.2,
  // ...
  std::vector<std::string> command = {"valgrind",
                                      "--tool=callgrind",
                                      "--quiet",
                                      "--collect-atstart=no",
                                      "--toggle-collect=gate_step",
                                      "--dump-after=gate_step",
                                      "--callgrind-out-file=" + out};
  ProbeSettings single = settings;
  single.repeats = 1;
  for (GateCase& entry : single.cases) entry.once = false;
  const std::vector<std::string> probe = probe_command(program, single);
  command.insert(command.end(), probe.begin(), probe.end());
  answer_of(command, single, kCountingTimeout);

  std::map<std::string, double> counts;
  int dump = 0;
  for (const GateCase& entry : settings.cases) {
    for (const char* step : {"triangulation", "outline"}) {
      counts[std::string(step) + " " + entry.name] = dumped_count(out + "." + std::to_string(++dump));
    }
  }
  return counts;
}

}  // namespace hullbench::gate
