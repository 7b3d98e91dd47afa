#include "tool/program/status_line.hpp"

namespace polylidar::tool {

void StatusLine::show(const std::string& text) {
  using namespace std::chrono_literals;
  const auto now = std::chrono::steady_clock::now();
  if (!terminal_ && shown_ && now - *shown_ < 15s) return;
  shown_ = now;
  out_ << (terminal_ ? "\r\033[K" : "") << text << (terminal_ ? "" : "\n") << std::flush;
}

void StatusLine::clear() {
  if (!terminal_ || !shown_) return;
  out_ << "\r\033[K" << std::flush;
  shown_.reset();
}

}  // namespace polylidar::tool
