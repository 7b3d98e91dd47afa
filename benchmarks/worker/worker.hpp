// The child's side of the worker protocol: one method, answering requests.
#pragma once

#include "adapters/adapter.hpp"
#include "benchmarks/base/exit_code.hpp"

namespace hullbench::worker {

/// Answers requests for the adapter that `entry` makes (protocol.hpp) on standard input and output until
/// `quit` or the end of the input. kExitError when the adapter cannot be made or a request is not understood.
///
/// From the first call on, the process's standard output goes to standard error and its standard input is
/// empty, so that a library that prints or reads cannot break into the protocol.
ExitCode run_worker(const AdapterEntry& entry);

}  // namespace hullbench::worker
