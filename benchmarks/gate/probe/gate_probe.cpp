// gate_probe: one process's times of one revision's core, for bench_gate.
//
//   gate_probe FOLDER [--repeats K] [--results FOLDER] [--once CASE]... CASE...
//
// FOLDER/CASE.f64 holds little-endian doubles: alpha, then x0 y0 x1 y1 ... of the points. A line on standard
// input (or its end) starts it; it answers with one line of JSON:
//
//   {"CASE": {"triangulation": [ns, ...], "outline": [ns, ...], "concave_hull_once": [ns, ...],
//             "result": "0123456789abcdef"}, ...}
//
// with K >= 1 (default 5) times each after a call that is not timed, all on one thread with an extractor that
// keeps its memory; "concave_hull_once", with fresh memory at every call, only of the cases named so.
// "result" is the FNV-1a hash of the WKB of the last repeat's result, which --results also writes as
// CASE.wkb. Exit code 2 and one sentence on standard error for anything that is not as above.
#include <bit>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "adapters/wkb.hpp"
#include "benchmarks/base/exit_code.hpp"
#include "benchmarks/gate/probe/measured_steps.hpp"

namespace {

using Nanoseconds = std::vector<std::int64_t>;
using Clock = std::chrono::steady_clock;

static_assert(std::endian::native == std::endian::little, "case files are read as they are");

struct Arguments {
  std::filesystem::path cases_folder;
  std::filesystem::path results_folder;  ///< empty: results are not written
  int repeats = 5;
  std::set<std::string> once;
  std::vector<std::string> cases;
};

struct Case {
  double alpha = 0;
  std::vector<polylidar::Point> points;
};

struct Times {
  Nanoseconds triangulation;
  Nanoseconds outline;
  Nanoseconds once;
  std::vector<std::uint8_t> wkb;  ///< the last repeat's result
};

Arguments parse(const std::vector<std::string>& words) {
  Arguments arguments;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word == "--repeats" || word == "--results" || word == "--once") {
      if (++i == words.size()) throw std::invalid_argument(word + " needs a value");
      if (word == "--repeats") arguments.repeats = std::stoi(words[i]);
      if (word == "--results") arguments.results_folder = words[i];
      if (word == "--once") arguments.once.insert(words[i]);
    } else if (arguments.cases_folder.empty()) {
      arguments.cases_folder = word;
    } else {
      arguments.cases.push_back(word);
    }
  }
  if (arguments.cases.empty()) throw std::invalid_argument("name the folder of cases and at least one case");
  if (arguments.repeats < 1) throw std::invalid_argument("--repeats must be 1 or more");
  return arguments;
}

Case read_case(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  const auto bytes = in ? static_cast<std::size_t>(in.tellg()) : 0;
  Case result;
  if (bytes < sizeof(double) || (bytes - sizeof(double)) % sizeof(polylidar::Point) != 0) {
    throw std::runtime_error(path.string() + " is no file of alpha and points");
  }
  result.points.resize((bytes - sizeof(double)) / sizeof(polylidar::Point));
  in.seekg(0);
  in.read(reinterpret_cast<char*>(&result.alpha), sizeof(double));
  in.read(reinterpret_cast<char*>(result.points.data()),
          static_cast<std::streamsize>(bytes - sizeof(double)));
  if (!in) throw std::runtime_error(path.string() + " cannot be read");
  return result;
}

std::int64_t nanoseconds(Clock::duration duration) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(duration).count();
}

Times measure(const Case& input, int repeats, bool once) {
  Times times;
  hullbench::StepData data;
  data.points = input.points;
  data.alpha = input.alpha;
  data.extractor.extract(input.points, {.alpha = input.alpha});  // not timed: memory grows, caches fill
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const auto start = Clock::now();
    gate_step(hullbench::Step::kTriangulation, data);
    const auto triangulated = Clock::now();
    gate_step(hullbench::Step::kOutline, data);
    const auto end = Clock::now();
    times.triangulation.push_back(nanoseconds(triangulated - start));
    times.outline.push_back(nanoseconds(end - triangulated));
  }
  times.wkb = hullbench::to_wkb(polylidar::to_coordinates(*data.shape, input.points));
  for (int repeat = 0; once && repeat < repeats; ++repeat) {
    const auto start = Clock::now();
    const auto made = polylidar::concave_hull(input.points, {.alpha = input.alpha});
    times.once.push_back(nanoseconds(Clock::now() - start));
    if (!(made == *data.shape))
      throw std::runtime_error("fresh memory gives another result than kept memory");
  }
  return times;
}

/// Fowler, Noll, Vo: FNV-1a with 64 bits.
std::string hash_of(const std::vector<std::uint8_t>& bytes) {
  std::uint64_t hash = 0xCBF29CE484222325U;
  for (const std::uint8_t byte : bytes) hash = (hash ^ byte) * 0x100000001B3U;
  std::string text(16, '0');
  for (std::size_t digit = 16; digit-- > 0; hash >>= 4U) text[digit] = "0123456789abcdef"[hash & 15U];
  return text;
}

std::string list_of(const Nanoseconds& times) {
  std::string text;
  for (const std::int64_t time : times) text += (text.empty() ? "" : ",") + std::to_string(time);
  return "[" + text + "]";
}

std::string json_of(const std::string& name, const Times& times) {
  std::string text = "\"" + name + "\":{\"triangulation\":" + list_of(times.triangulation) +
                     ",\"outline\":" + list_of(times.outline);
  if (!times.once.empty()) text += ",\"concave_hull_once\":" + list_of(times.once);
  return text + ",\"result\":\"" + hash_of(times.wkb) + "\"}";
}

void write_result(const std::filesystem::path& path, const std::vector<std::uint8_t>& wkb) {
  std::ofstream out(path, std::ios::binary);
  out.write(reinterpret_cast<const char*>(wkb.data()), static_cast<std::streamsize>(wkb.size()));
  out.close();
  if (!out) throw std::runtime_error(path.string() + " cannot be written");
}

void run(const Arguments& arguments) {
  std::string request;
  std::getline(std::cin, request);
  std::string answer;
  for (const std::string& name : arguments.cases) {
    const Case input = read_case(arguments.cases_folder / (name + ".f64"));
    const Times times = measure(input, arguments.repeats, arguments.once.count(name) != 0);
    if (!arguments.results_folder.empty())
      write_result(arguments.results_folder / (name + ".wkb"), times.wkb);
    answer += (answer.empty() ? "" : ",") + json_of(name, times);
  }
  std::cout << "{" << answer << "}\n" << std::flush;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(parse({argv + 1, argv + argc}));
    return hullbench::kExitOk;
  } catch (const std::exception& error) {
    std::cerr << "gate_probe: " << error.what() << "\n";
    return hullbench::kExitUsage;
  }
}
