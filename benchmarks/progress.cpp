#include "benchmarks/progress.hpp"

#include <algorithm>
#include <cmath>

namespace hullbench {
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

Progress::Progress(std::ostream& out, bool terminal, std::size_t width, std::vector<ProgressRun> runs)
    : out_(out),
      terminal_(terminal),
      width_(width),
      runs_(std::move(runs)),
      finished_(runs_.size(), false),
      start_(Clock::now()),
      first_run_(start_),
      shown_(start_) {}

void Progress::begin(std::size_t index) {
  current_ = index;
  if (rates_.empty()) first_run_ = Clock::now();
  show(false);
}

void Progress::advance(std::size_t index, std::chrono::nanoseconds elapsed) {
  ProgressRun& run = runs_[index];
  run.units = std::max(0, run.units - 1);
  Rate& rate = rates_[run.method];
  rate.seconds += seconds_of(elapsed);
  rate.points += static_cast<double>(run.n);
  show(false);
}

void Progress::finish(std::size_t index) {
  if (finished_[index]) return;
  finished_[index] = true;
  ++finished_count_;
  runs_[index].units = 0;
  show(finished_count_ == runs_.size());
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
  Rate all;
  for (const auto& [method, rate] : rates_) {
    all.seconds += rate.seconds;
    all.points += rate.points;
  }
  if (!(all.seconds > 0) || !(all.points > 0)) return -1;
  double left = 0;
  for (const ProgressRun& run : runs_) {
    const auto known = rates_.find(run.method);
    const Rate& rate = known == rates_.end() ? all : known->second;
    left += run.units * static_cast<double>(run.n) * rate.seconds / rate.points;
  }
  // What goes on between the runs (samples, scores, files) takes its share in the future as it did so far.
  const double elapsed = seconds_of(Clock::now() - first_run_);
  return left * std::max(1.0, elapsed / all.seconds);
}

std::string Progress::line() const {
  std::string text = "[" + std::to_string(finished_count_) + "/" + std::to_string(runs_.size()) + "] " +
                     format_duration(seconds_of(Clock::now() - start_));
  if (finished_count_ == runs_.size()) return text + ", done";
  const double left = seconds_left();
  text += left < 0 ? ", time left not known yet" : ", about " + format_duration(left) + " left (estimated)";
  return text + ": " + runs_[current_].name;
}

void Progress::show(bool now) {
  const auto interval =
      terminal_ ? std::chrono::milliseconds(kTerminalInterval) : std::chrono::milliseconds(kPlainInterval);
  if (runs_.empty() || (!now && Clock::now() - shown_ < interval)) return;
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

}  // namespace hullbench
