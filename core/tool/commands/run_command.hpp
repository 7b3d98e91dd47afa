// How every command runs.
#pragma once

#include <csignal>
#include <new>
#include <stdexcept>
#include <string>

#include "tool/points/point_file.hpp"
#include "tool/program/configuration_error.hpp"
#include "tool/program/exit_code.hpp"

namespace polylidar::tool {

/// Returns what `run` returns. What it throws because of the points of `input`, as they are called in errors,
/// becomes a ConfigurationError, or a std::runtime_error if they need too much memory.
template <class Run>
ExitCode run_command(const std::string& input, const Run& run) {
  // A closed pipe is then an error of writing, which is told like others.
  (void)::signal(SIGPIPE, SIG_IGN);
  try {
    return run();
  } catch (const std::invalid_argument& error) {
    throw ConfigurationError(input + ": " + error.what());
  } catch (const PointFileError& error) {
    throw ConfigurationError(error.what());
  } catch (const std::bad_alloc&) {
    throw std::runtime_error("there is not enough memory for the points of " + input +
                             "; give fewer of them, or use a machine with more");
  }
}

}  // namespace polylidar::tool
