#include "benchmarks/gate/gate_blocks.hpp"

#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "benchmarks/base/interrupt.hpp"
#include "datasets/random.hpp"

namespace hullbench::gate {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBase = 0;
constexpr std::size_t kHead = 1;
constexpr std::size_t kBaseAgain = 2;

using Order = std::array<std::size_t, 6>;

/// A random permutation of the three, and its mirror image.
Order random_order(Random& random) {
  std::array<std::size_t, 3> turn = {kBase, kHead, kBaseAgain};
  for (std::size_t i = turn.size() - 1; i > 0; --i) std::swap(turn[i], turn[random.below(i + 1)]);
  return {turn[0], turn[1], turn[2], turn[2], turn[1], turn[0]};
}

fs::path place(const fs::path& program, const fs::path& folder) {
  fs::create_directories(folder);
  fs::path copy = folder / "gate_probe";
  fs::copy_file(program, copy, fs::copy_options::overwrite_existing);
  return copy;
}

/// Keeps the first result of every case, and compares the later ones with it.
void check_results(const fs::path& program, const ProbeTimes& times,
                   std::map<std::string, std::string>& results) {
  for (const auto& [name, result] : times.results) {
    if (results.emplace(name, result).first->second == result) continue;
    throw std::runtime_error("two runs of " + program.string() + " give different results for " + name +
                             ": it cannot be gated before it always gives the same");
  }
}

}  // namespace

Programs place_programs(const fs::path& base, const fs::path& head, const fs::path& folder) {
  return {place(base, folder / "1"), place(head, folder / "2"), place(base, folder / "3")};
}

void measure_blocks(const Programs& programs, const ProbeSettings& settings, std::size_t count,
                    std::uint64_t seed, std::chrono::steady_clock::time_point deadline,
                    const std::function<void()>& before_process, Blocks& blocks) {
  Random random(seed);
  const std::array<fs::path, 3> places = {programs.base, programs.head, programs.base_again};
  std::array<std::map<std::string, std::string>, 3> results;
  for (std::size_t block = 0; block < count; ++block) {
    if (std::chrono::steady_clock::now() >= deadline) return;
    std::array<std::map<std::string, double>, 3> log_time;  // mean of the two runs' logarithms
    for (const std::size_t which : random_order(random)) {
      throw_if_interrupted();
      before_process();
      const ProbeTimes times = run_probe(places[which], settings);
      check_results(places[which], times, results[which]);
      for (const auto& [name, ns] : times.ns) log_time[which][name] += std::log(ns) / 2;
    }
    for (const auto& [name, base] : log_time[kBase]) {
      blocks.change[name].push_back(log_time[kHead].at(name) - base);
      blocks.null_control[name].push_back(log_time[kBaseAgain].at(name) - base);
    }
  }
}

std::vector<LogRatios> log_ratios(const std::map<std::string, std::vector<double>>& values, double sign) {
  std::vector<LogRatios> rows;
  for (const auto& [name, ratios] : values) {
    rows.push_back({name, ratios});
    for (double& value : rows.back().values) value *= sign;
  }
  return rows;
}

}  // namespace hullbench::gate
