// What a long work is at.
#pragma once

#include <chrono>
#include <optional>
#include <ostream>
#include <string>

namespace polylidar::tool {

/// On a terminal one line that is rewritten, and gone in the end; elsewhere a plain line, at once and then
/// every 15 s.
class StatusLine {
 public:
  /// `terminal`: whether `out` can rewrite a line.
  StatusLine(std::ostream& out, bool terminal) : out_(out), terminal_(terminal) {}
  ~StatusLine() { clear(); }
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  void show(const std::string& text);
  /// Takes the rewritten line away.
  void clear();

 private:
  std::ostream& out_;
  bool terminal_;
  std::optional<std::chrono::steady_clock::time_point> shown_;  ///< none: nothing is there to be rewritten
};

}  // namespace polylidar::tool
