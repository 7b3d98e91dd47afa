// What the gate on speed measures.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace hullbench::gate {

struct GateCase {
  std::string name;       ///< "ca-64000": the point set and its number of points
  std::string point_set;  ///< as make_speed_point_set names it
  std::size_t n = 0;
  bool once = false;  ///< whether calls with fresh memory are measured too: the system's pages, not our code
};

/// Cases that a process measures in about 0.15 s.
std::vector<GateCase> time_cases();

/// Smaller ones: counting takes some fifty times as long as running.
std::vector<GateCase> instruction_cases();

/// Writes FOLDER/NAME.f64 of every case, as gate_probe reads it. Throws std::runtime_error naming a file that
/// cannot be written.
void write_cases(const std::vector<GateCase>& cases, const std::filesystem::path& folder);

}  // namespace hullbench::gate
