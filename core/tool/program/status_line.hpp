// What a long work is at.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <ostream>
#include <stop_token>
#include <string>
#include <thread>

namespace polylidar::tool {

/// On a terminal one line that is rewritten, and gone in the end; elsewhere a plain line every 15 s. Any
/// thread may call.
class StatusLine {
 public:
  using Duration = std::chrono::milliseconds;

  /// `terminal`: whether `out` can rewrite a line. Nothing is written before `quiet` is over, and nothing at
  /// all where the work takes less; what was shown last is written then, by a thread that waits for it.
  StatusLine(std::ostream& out, bool terminal, Duration quiet = Duration(0));
  ~StatusLine() { clear(); }
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  void show(const std::string& text);
  /// Whether the last show() was long enough ago for another one of a number that grows.
  bool is_due();
  /// A line that stays.
  void say(const std::string& line);
  /// Takes the rewritten line away, and what waits. Until the next show() others may write to `out`.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  void erase();
  void write_waiting();
  void write_in_time(const std::stop_token& stop);

  std::ostream& out_;
  const bool terminal_;
  const bool has_writer_;
  std::mutex mutex_;                     ///< of all that follows
  Clock::time_point next_;               ///< nothing is written before
  Clock::time_point last_;               ///< of show()
  std::string waiting_;                  ///< what is not written yet; mostly empty
  bool is_shown_ = false;                ///< a line is there to be rewritten
  std::condition_variable_any changed_;  ///< something waits
  std::jthread writer_;                  ///< where there is a quiet time
};

/// How long a command for people is quiet: work of a moment shows nothing.
inline StatusLine::Duration quiet_time(bool terminal) {
  return std::chrono::seconds(terminal ? 1 : 15);
}

}  // namespace polylidar::tool
