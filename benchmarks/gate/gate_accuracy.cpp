#include "benchmarks/gate/gate_accuracy.hpp"

#include <cstddef>
#include <exception>
#include <limits>

#include "adapters/wkb.hpp"
#include "benchmarks/metrics/area.hpp"
#include "benchmarks/worker/protocol.hpp"

namespace hullbench::gate {
namespace {

AccuracyRow compare(const std::string& name, const fs::path& base, const fs::path& head) {
  AccuracyRow row;
  row.name = name;
  row.difference = std::numeric_limits<double>::infinity();
  try {
    constexpr std::size_t kAnySize = std::numeric_limits<std::size_t>::max();
    const auto base_bytes = worker::read_bytes(base, kAnySize);
    const auto head_bytes = worker::read_bytes(head, kAnySize);
    row.same = base_bytes == head_bytes;
    if (row.same) {
      row.difference = 0;
      return row;
    }
    const metrics::AreaScores scores = metrics::area_scores(from_wkb(head_bytes), from_wkb(base_bytes));
    if (scores.l2) {
      row.difference = *scores.l2;
    } else {
      row.reason = "head's result is not valid: " + scores.invalid_reason;
    }
  } catch (const std::exception& error) {
    row.reason = error.what();
  }
  return row;
}

}  // namespace

std::vector<AccuracyRow> compare_results(const std::vector<GateCase>& cases, const fs::path& base,
                                         const fs::path& head) {
  std::vector<AccuracyRow> rows;
  for (const GateCase& entry : cases) {
    const std::string file = entry.name + ".wkb";
    rows.push_back(compare(entry.name, base / file, head / file));
  }
  return rows;
}

}  // namespace hullbench::gate
