// Where a result goes: to standard output or into a file, whole or not at all.
#pragma once

#include <string>
#include <string_view>

namespace hullbench::cli {

/// Throws std::runtime_error when no file can be written at `path`, which would otherwise be known only when
/// the result is there. Nothing to check for an empty path, standard output.
void check_output_place(const std::string& path);

/// Writes `bytes` to standard output (empty `path`) or into a file of another name that then becomes `path`,
/// so that nobody ever sees half a result; what is there and is no file (a device, a named pipe) is written
/// to. Throws std::runtime_error when that fails (disk full, pipe closed), Interrupted when interrupted.
/// Standard output: SIGPIPE must be ignored.
void write_result(const std::string& path, std::string_view bytes);

}  // namespace hullbench::cli
