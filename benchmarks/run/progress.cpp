#include "benchmarks/run/progress.hpp"

#include <algorithm>
#include <cmath>

namespace hullbench::run {
namespace {

using namespace std::chrono_literals;

/// A terminal is redrawn at most this often: the harness must not disturb what it measures.
constexpr auto kTerminalInterval = 200ms;
/// Plain lines, as they end up in log files.
constexpr auto kPlainInterval = 15s;

double seconds_of(std::chrono::nanoseconds duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace

Progress::Progress(std::ostream& out, bool terminal, std::size_t width, std::vector<ProgressSection> sections)
    : out_(out), terminal_(terminal), width_(width), start_(Clock::now()), shown_(start_) {
  for (ProgressSection& given : sections) {
    Section& added = sections_.emplace_back();
    added.title = std::move(given.title);
    added.plan = std::move(given.plan);
    added.finished.resize(given.runs.size());
    added.runs = std::move(given.runs);
    added.first_run = start_;
  }
}

void Progress::enter(std::size_t section) {
  for (std::size_t earlier = current_section_; earlier < section; ++earlier) {
    for (ProgressRun& run : sections_[earlier].runs) run.units = 0;
  }
  current_section_ = section;
  current_run_ = 0;
}

void Progress::begin(std::size_t index) {
  current_run_ = index;
  if (section().rates.empty()) section().first_run = Clock::now();
  show(false);
}

void Progress::advance(std::size_t index, std::chrono::nanoseconds elapsed) {
  ProgressRun& run = section().runs[index];
  run.units = std::max(0, run.units - 1);
  Rate& rate = section().rates[run.method];
  rate.seconds += seconds_of(elapsed);
  rate.points += static_cast<double>(run.n);
  show(false);
}

void Progress::repeat(std::size_t index) {
  ++section().runs[index].units;
}

void Progress::finish(std::size_t index) {
  Section& here = section();
  if (here.finished[index]) return;
  here.finished[index] = true;
  ++here.finished_count;
  here.runs[index].units = 0;
  show(here.finished_count == here.runs.size());
}

void Progress::note(const std::string& text) {
  if (terminal_) out_ << "\r\033[K";
  out_ << text << "\n" << std::flush;
  if (terminal_) show(true);
}

void Progress::end() {
  if (terminal_) out_ << "\r\033[K" << std::flush;
}

double Progress::seconds_left() const {
  Rates everywhere = rates_of_plan("");
  const Rate& all = everywhere[std::string()];
  if (!(all.seconds > 0) || !(all.points > 0)) return -1;
  double left = 0;
  for (const Section& section : sections_) left += seconds_left(section, everywhere);
  return left;
}

Progress::Rates Progress::rates_of_plan(const std::string& plan) const {
  Rates result;
  for (const Section& section : sections_) {
    if (!plan.empty() && section.plan != plan) continue;
    for (const auto& [method, rate] : section.rates) {
      for (const std::string& name : {method, std::string()}) {
        result[name].seconds += rate.seconds;
        result[name].points += rate.points;
      }
    }
  }
  return result;
}

double Progress::seconds_left(const Section& section, const Rates& rates_elsewhere) const {
  const Rates rates_of_same_plan = rates_of_plan(section.plan);
  const auto rate_of = [&](const std::string& method) {
    for (const Rates* rates : {&section.rates, &rates_of_same_plan, &rates_elsewhere}) {
      if (const auto known = rates->find(method); known != rates->end()) return known->second;
    }
    return rates_elsewhere.at(std::string());
  };
  double left = 0;
  for (const ProgressRun& run : section.runs) {
    const Rate rate = rate_of(run.method);
    left += run.units * static_cast<double>(run.n) * rate.seconds / rate.points;
  }
  double measured = 0;
  for (const auto& [method, rate] : section.rates) measured += rate.seconds;
  if (!(measured > 0)) return left;
  // What goes on between the runs (samples, scores, files) takes its share in the future as it did so far.
  return left * std::max(1.0, seconds_of(Clock::now() - section.first_run) / measured);
}

std::string Progress::line() const {
  const Section& here = section();
  std::string text = here.title.empty() ? "" : here.title + " ";
  text += "[" + std::to_string(here.finished_count) + "/" + std::to_string(here.runs.size()) + "] " +
          format_duration(seconds_of(Clock::now() - start_));
  const bool last = current_section_ + 1 == sections_.size();
  if (last && here.finished_count == here.runs.size()) return text + ", done";
  const double left = seconds_left();
  text += left < 0 ? ", time left not known yet" : ", about " + format_duration(left) + " left (estimated)";
  return text + ": " + here.runs[current_run_].name;
}

void Progress::show(bool now) {
  const auto interval =
      terminal_ ? std::chrono::milliseconds(kTerminalInterval) : std::chrono::milliseconds(kPlainInterval);
  if (section().runs.empty() || (!now && Clock::now() - shown_ < interval)) return;
  shown_ = Clock::now();
  if (!terminal_) {
    out_ << "hullbench: " << line() << "\n" << std::flush;
    return;
  }
  out_ << "\r\033[K" << line().substr(0, width_ > 1 ? width_ - 1 : 0) << std::flush;
}

std::string format_duration(double seconds) {
  const auto total = static_cast<long long>(std::llround(std::max(0.0, seconds)));
  if (total < 60) return std::to_string(total) + " s";
  if (total < 3600) return std::to_string(total / 60) + " min " + std::to_string(total % 60) + " s";
  return std::to_string(total / 3600) + " h " + std::to_string(total % 3600 / 60) + " min";
}

}  // namespace hullbench::run
