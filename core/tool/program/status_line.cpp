#include "tool/program/status_line.hpp"

#include <csignal>

namespace polylidar::tool {

StatusLine::StatusLine(std::ostream& out, bool terminal, Duration quiet)
    : out_(out), terminal_(terminal), has_writer_(quiet > Duration(0)), next_(Clock::now() + quiet) {
  if (has_writer_) writer_ = std::jthread([this](const std::stop_token& stop) { write_in_time(stop); });
}

void StatusLine::show(const std::string& text) {
  const std::lock_guard lock(mutex_);
  waiting_ = text;
  last_ = Clock::now();
  if (last_ >= next_) {
    write_waiting();
  } else {
    changed_.notify_one();
  }
}

bool StatusLine::is_due() {
  const std::lock_guard lock(mutex_);
  return Clock::now() - last_ >= std::chrono::milliseconds(50);
}

void StatusLine::say(const std::string& line) {
  const std::lock_guard lock(mutex_);
  erase();
  out_ << line << "\n";
}

void StatusLine::clear() {
  const std::lock_guard lock(mutex_);
  waiting_.clear();
  erase();
}

void StatusLine::erase() {
  if (is_shown_) out_ << "\r\033[K" << std::flush;
  is_shown_ = false;
}

void StatusLine::write_waiting() {
  using namespace std::chrono_literals;
  // What comes faster than a person reads waits for the thread, where there is one.
  next_ = Clock::now() + (!terminal_ ? 15s : has_writer_ ? 100ms : 0ms);
  is_shown_ = terminal_;
  out_ << (terminal_ ? "\r\033[K" : "") << waiting_ << (terminal_ ? "" : "\n") << std::flush;
  waiting_.clear();
}

void StatusLine::write_in_time(const std::stop_token& stop) {
  // Signals are for the thread that works: they end its waiting for input.
  sigset_t all;
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, nullptr);
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [&] { return !waiting_.empty(); })) {
    const Clock::time_point next = next_;
    changed_.wait_until(lock, stop, next, [&] { return waiting_.empty(); });
    if (stop.stop_requested()) return;
    if (!waiting_.empty() && Clock::now() >= next_) write_waiting();
  }
}

}  // namespace polylidar::tool
