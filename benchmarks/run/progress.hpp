// How far a run is and how long it will take, on standard error.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <ostream>
#include <string>
#include <vector>

namespace hullbench::run {

/// One run as the estimate sees it: `units` repetitions, warm-up included, of `method` on n points.
struct ProgressRun {
  std::string name;
  std::string method;
  std::int64_t n = 0;
  int units = 0;
};

/// The runs of one plan in one of its passes.
struct ProgressSection {
  std::string title;  ///< before everything else in the line; may be empty
  std::vector<ProgressRun> runs;
  std::string plan = {};  ///< sections of one plan take as long as one another; empty: of none
};

/// On a terminal one line that is rewritten; elsewhere a plain line now and then. The time left, of all
/// sections together, is estimated from the measured times of each method in its section, taken as
/// proportional to n; of a method that has none there, from its times in the sections of the same plan, else
/// in all sections, and without those as the mean of the others.
class Progress {
 public:
  /// `terminal`: whether `out` can rewrite a line; `width`: its columns. The first section is entered.
  Progress(std::ostream& out, bool terminal, std::size_t width, std::vector<ProgressSection> sections);

  /// From now on indices are those of this section's runs. What was left in earlier ones counts as done.
  void enter(std::size_t section);
  /// Run `index` is being worked on.
  void begin(std::size_t index);
  /// One unit of run `index` took `elapsed`.
  void advance(std::size_t index, std::chrono::nanoseconds elapsed);
  /// One unit of run `index` is to be done once more.
  void repeat(std::size_t index);
  /// Nothing is left to do of run `index`.
  void finish(std::size_t index);
  /// A line that stays.
  void note(const std::string& text);
  /// Takes the rewritten line away.
  void end();

  /// Seconds left; negative while nothing is measured.
  double seconds_left() const;

 private:
  using Clock = std::chrono::steady_clock;
  struct Rate {
    double seconds = 0;
    double points = 0;
  };

  using Rates = std::map<std::string, Rate>;  ///< by method
  struct Section {
    std::string title;
    std::string plan;
    std::vector<ProgressRun> runs;  ///< `units` counts down to 0
    std::vector<bool> finished;     ///< by run
    std::size_t finished_count = 0;
    Rates rates;
    Clock::time_point first_run;  ///< when measuring began: methods may take long to start, once
  };

  Section& section() { return sections_[current_section_]; }
  const Section& section() const { return sections_[current_section_]; }
  /// The rates of the sections of that plan together, or of all when it is empty; of all methods under the
  /// empty name.
  Rates rates_of_plan(const std::string& plan) const;
  double seconds_left(const Section& section, const Rates& rates_elsewhere) const;
  void show(bool now);
  std::string line() const;

  std::ostream& out_;
  bool terminal_;
  std::size_t width_;
  std::vector<Section> sections_;
  std::size_t current_section_ = 0;
  std::size_t current_run_ = 0;
  Clock::time_point start_;
  Clock::time_point shown_;
};

/// "48 s", "3 min 20 s", "2 h 5 min".
std::string format_duration(double seconds);

}  // namespace hullbench::run
