#include "tool/program/interrupt.hpp"

#include <atomic>
#include <csignal>

namespace polylidar::tool {
namespace {

std::atomic<bool> flag{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may touch lock-free atomics only");

void handle(int) {
  flag = true;
}

}  // namespace

void catch_interruptions() {
  struct sigaction action {};
  action.sa_handler = &handle;
  // No SA_RESTART: a wait for a worker must return to look at the flag.
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    // What the caller chose to ignore (nohup) stays ignored.
    if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
}

bool interrupted() {
  return flag;
}

void throw_if_interrupted() {
  if (interrupted()) throw Interrupted();
}

void set_interrupted(bool value) {
  flag = value;
}

}  // namespace polylidar::tool
