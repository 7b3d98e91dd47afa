// Ctrl-C.
#pragma once

#include <stdexcept>

namespace polylidar::tool {

/// Thrown at the next safe place after an interruption, when nothing is half-written.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

/// From now on the first SIGINT, SIGTERM or SIGHUP only sets a flag; a second one of the same kind ends the
/// program at once.
void catch_interruptions();

/// Whether one came.
bool interrupted();

/// Throws Interrupted when one came.
void throw_if_interrupted();

/// Sets the flag as a signal would (true), or forgets it (false): for tests.
void set_interrupted(bool value);

}  // namespace polylidar::tool
