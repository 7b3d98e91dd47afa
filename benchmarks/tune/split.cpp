#include "benchmarks/tune/split.hpp"

#include <algorithm>

#include "datasets/datasets.hpp"
#include "datasets/stress.hpp"

namespace hullbench::tune {
namespace {

const SplitRow* find_row(const std::vector<SplitRow>& rows, const std::string& name) {
  const auto found = std::ranges::find_if(rows, [&](const SplitRow& row) { return row.name == name; });
  return found == rows.end() ? nullptr : &*found;
}

}  // namespace

std::string to_string(Side side) {
  switch (side) {
    case Side::kTraining:
      return "training";
    case Side::kTest:
      return "test";
    default:
      return "neither";
  }
}

// The rule: what the paper reports is for tests, and so is what comes from elsewhere than the training
// shapes.
const std::vector<SplitRow>& shape_split() {
  using enum Side;
  static const std::vector<SplitRow> rows = {
      {"star", kTraining, "Made here in any number, and the paper gives no single star's result."},
      {"comb", kTraining, "Made here in any number: narrow gaps side by side."},
      {"spiral", kTraining, "Made here in any number: one long and narrow arm."},
      {"partition", kTraining, "Made here in any number: an outline without a favoured width."},
      {"walk", kTraining, "Made here in any number: rough outlines."},
      {"nested", kTraining, "Made here in any number: holes, and parts in them."},
      {"parts", kTraining, "Made here in any number: several parts, without holes."},
      {"cell", kTest, "Simple shapes that touch others; nothing was fitted to their sampler."},
      {"county", kTraining,
       "Real borders, so that training has more than what was made here; countries test them. County 10 is "
       "in California, which is a test, so no plan has it."},
      {"fashion", kTraining, "Silhouettes with and without holes; clip art, drawn by others, tests them."},
      {"han", kTraining, "Characters of many parts; letters and symbols, of other fonts, test them."},
      {"state", kTest, "The paper reports them."},
      {"letter", kTest, "The paper reports them."},
      {"floor", kTest, "The paper reports such floors."},
      {"lowfloor", kTest, "Floors as the paper's, from a low camera."},
      {"recorded", kTest, "Floors that users recorded: nothing may be fitted to them."},
      {"towns", kTest, "Real points and a truth of somebody else: no search may see them."},
      {"country", kTest,
       "Real borders by another author than the counties': fjords, archipelagos, enclaves."},
      {"clipart", kTest, "Silhouettes by many authors."},
      {"symbol", kTest, "Glyphs that are no writing."},
      {"pierced", kTest, "Graded, round holes: shows what a method can see, and is no sample of any world."},
      {"annulus", kTest,
       "Graded, one round hole: shows what a method can see, and is no sample of any world."},
      {"windows", kTest, "Graded, square holes: shows what a method can see, and is no sample of any world."},
      {"channel", kTest, "Graded, a channel: shows what a method can see, and is no sample of any world."},
      {"peninsula", kTest, "Graded, a bar: shows what a method can see, and is no sample of any world."},
      {"teeth", kTest, "Graded, teeth: shows what a method can see, and is no sample of any world."},
      {"squares", kTest, "Graded, gaps: shows what a method can see, and is no sample of any world."},
      {"discs", kTest, "Graded, gaps: shows what a method can see, and is no sample of any world."},
      {"strips", kTest, "Graded, gaps: shows what a method can see, and is no sample of any world."},
      {"degenerate", kNeither, "Asks how a run ends; an error there says nothing about shapes."},
      {"zoo", kNeither, "Asks how a run ends; an error there says nothing about shapes."},
      {"real", kNeither, "Has no truth, so nothing can be fitted to it and no error measured."}};
  return rows;
}

// The rule: training has a plain example of each way in which points differ, in density, in regularity and in
// faults; the sensors' own patterns stay unseen, so that a rule that fits one of them gains nothing.
const std::vector<SplitRow>& sampler_split() {
  using enum Side;
  static const std::vector<SplitRow> rows = {
      {"uniform", kTraining, "The paper's sampling."},
      {"gradient", kTraining, "The plain example of a density that varies slowly."},
      {"clusters", kTraining, "The plain example of a density that varies fast."},
      {"cascade", kTraining, "The plain example of a density that varies on all scales."},
      {"poisson", kTraining, "The plain example of points that are more even than chance."},
      {"noise", kTraining, "A fault that every sensor has."},
      {"outliers", kTraining, "A fault that most sensors have."},
      {"airborne", kTraining, "The plain example of scan lines: parallel ones."},
      {"hotspot", kTest, "Another varying density than the gradient's."},
      {"quantised", kTest, "Another regularity than Poisson disks': points that fall on each other."},
      {"lattice", kTest, "Another regularity than Poisson disks': rows and columns."},
      {"boundary", kTest, "Needs the outline itself, which no sensor knows: nobody may fit to it."},
      {"outline", kTest,
       "Needs the outline itself, like boundary: no search may use it. The core has a rule made for such "
       "points."},
      {"water", kTest, "A scanner's fault: lakes without points, which no rule may learn to fill."},
      {"depthcamera", kTest, "A sensor's own pattern, and that of the paper's floors."},
      {"zigzag", kTest, "Another pattern of scan lines than parallel ones."},
      {"rotating", kTest, "Another pattern of scan lines than parallel ones: rings."},
      {"tracks", kTest, "Another pattern of lines than a scanner's: roads that cross."},
      {"transcripts", kTest, "A dense middle, and points of neighbours beyond the border."}};
  return rows;
}

std::string source_of(const std::string& dataset) {
  const std::string shape = base_shape(dataset);
  if (shape == "ca" || shape == "hi") return "state";
  for (const char* source : {"letter", "degenerate"}) {
    if (shape.starts_with(std::string(source) + "_")) return source;
  }
  for (const char* source : {"zoo", "real", "towns"}) {
    if (shape.starts_with(std::string(source) + "-")) return source;
  }
  const auto member = split_member_name(shape);
  return member ? member->first : shape;
}

std::vector<std::string> samplers_of(const std::string& dataset) {
  const std::string source = source_of(dataset);
  if (source.ends_with(kSimulatedFloor) || source == kRecordedFloor) return {"depthcamera"};
  if (source == "towns") return {"towns"};  // as people settle
  std::vector<std::string> samplers;
  if (const auto parts = split_stress(dataset)) {
    for (const Stress& stress : parts->second) samplers.push_back(stress.kind->name);
  }
  if (samplers.empty()) samplers.emplace_back("uniform");
  return samplers;
}

bool has_unseen_sampler(const std::string& dataset) {
  const std::vector<std::string> samplers = samplers_of(dataset);
  return std::ranges::any_of(samplers, [](const std::string& sampler) {
    const SplitRow* row = find_row(sampler_split(), sampler);
    return row == nullptr || row->side != Side::kTraining;
  });
}

Side side_of(const std::string& dataset) {
  const SplitRow* row = find_row(shape_split(), source_of(dataset));
  if (row == nullptr) return Side::kNeither;
  return row->side == Side::kTraining && has_unseen_sampler(dataset) ? Side::kNeither : row->side;
}

json split_to_json() {
  json split;
  for (const SplitRow& row : shape_split()) split["shapes"][row.name] = to_string(row.side);
  for (const SplitRow& row : sampler_split()) split["samplers"][row.name] = to_string(row.side);
  return split;
}

}  // namespace hullbench::tune
