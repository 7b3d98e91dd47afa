// Processes that a method leaves behind: each worker is started with a mark of its own in its environment,
// which whatever it starts inherits, in whatever session or group it hides.
#pragma once

#include <string>

namespace hullbench::worker {

/// The environment variable that carries the mark.
inline constexpr const char* kMarkVariable = "HULLBENCH_WORKER";

/// A new mark: this process, as process_identity names it, and a number.
std::string new_worker_mark();

/// Ends every process that has `mark` in its environment and is not this one: asks with SIGTERM, waits for
/// some seconds, as a server's supervisor may be cleaning up, and kills what is left then. Processes of other
/// users, and those that threw their environment away, cannot be seen.
void end_strays(const std::string& mark);

/// Does that with what the workers of harnesses left behind that do not live any more.
void end_strays_of_dead_harnesses();

}  // namespace hullbench::worker
