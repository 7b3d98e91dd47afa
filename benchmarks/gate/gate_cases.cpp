#include "benchmarks/gate/gate_cases.hpp"

#include "benchmarks/base/files.hpp"
#include "benchmarks/micro/point_sets.hpp"
#include "datasets/point_bytes.hpp"

namespace hullbench::gate {
namespace {

GateCase make_case(const std::string& point_set, std::size_t n, bool once = false) {
  return {point_set + "-" + std::to_string(n), point_set, n, once};
}

}  // namespace

// Sizes that stay in a processor's cache and one that does not; an outline of one ring, and of many polygons
// (as "islands" falls into with so few points a square); points that are all degenerate. Small ones on the
// whole, so that a gate has time for many processes: the sign test counts blocks, and no burst of noise
// spoils many of them.
std::vector<GateCase> time_cases() {
  return {make_case("ca", 8'000, true), make_case("ca", 64'000),   make_case("uniform", 16'000),
          make_case("lattice", 16'000), make_case("rgbd", 16'000), make_case("islands", 16'000)};
}

std::vector<GateCase> instruction_cases() {
  return {make_case("ca", 2'000),      make_case("ca", 8'000),   make_case("uniform", 8'000),
          make_case("lattice", 8'000), make_case("rgbd", 8'000), make_case("islands", 16'000)};
}

void write_cases(const std::vector<GateCase>& cases, const fs::path& folder) {
  fs::create_directories(folder);
  for (const GateCase& entry : cases) {
    const micro::SpeedPointSet set = micro::make_speed_point_set(entry.point_set, entry.n);
    const Point alpha[] = {{set.alpha, 0}};
    write_text_file(folder / (entry.name + ".f64"),
                    point_bytes(alpha).substr(0, 8) + point_bytes(set.points));
  }
}

}  // namespace hullbench::gate
