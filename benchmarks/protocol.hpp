// The worker protocol, version 1: how the harness speaks with a method in another process.
//
// Requests come on the worker's standard input and replies go to its standard output, one JSON object a line,
// a reply to each request but `quit`. Points and results travel in files, so that a line stays short
// (kMaxLineBytes).
//
//   {"request":"hello","protocol":1}
//     -> {"protocol":1,"method":{...}}                      who the method is: see method_to_json
//   {"request":"load","points":"FILE","n":2000}             x0 y0 x1 y1 ... as raw little-endian float64, 16
//   n bytes
//     -> {"phases_ns":{"load":12345}}
//   {"request":"run","nonce":"NONCE","parameters":{"alpha":5.4},"result":"FILE"}
//     -> {"nonce":"NONCE","phases_ns":{"run":1234,"extract":123,"run.triangulation":1000,"run.shape":234}}
//        and the result as WKB in FILE, written after the clock has stopped
//   {"request":"quit"}                                      the worker ends; so it does when its input ends
//
// Instead of any of these replies: {"error":{"kind":KIND,"message":"one sentence"}} with KIND one of `error`,
// `unsupported`, `invalid_argument`, `memory` and, to `hello` only, `not_installed`, then with "remedy": the
// command that helps. After an error the worker goes on listening, except after `hello`.
//
// A number that is infinite is written as null. Times are integer nanoseconds of a steady clock; `run` and
// `extract` are required, `run.<step>` and `extract.<step>` are optional and part of them. What a worker
// writes to standard error is kept as an explanation should it die.
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "adapters/adapter.hpp"

namespace hullbench {

inline constexpr int kProtocolVersion = 1;

/// The longest line either side may send, line feed included.
inline constexpr std::size_t kMaxLineBytes = std::size_t{1024} * 1024;

/// {name, title, version, licence, citation, native_output, parameters: [{name, unit, description, minimum,
/// maximum, default}], capabilities: {holes, several_polygons}}. An infinite limit or default is null; a
/// parameter that is required has no member "default".
nlohmann::json method_to_json(const MethodInfo& info);
/// Throws nlohmann::json::exception or std::invalid_argument when a member is missing or of the wrong type.
MethodInfo method_from_json(const nlohmann::json& source);

/// {name: value}; infinity is null.
nlohmann::json parameters_to_json(const Parameters& parameters);
/// Throws std::invalid_argument when a value is neither a number nor null.
Parameters parameters_from_json(const nlohmann::json& source);

/// Writes `points` as `load` wants them. Throws std::runtime_error naming the file when it cannot be written.
void write_points_file(const std::filesystem::path& path, std::span<const Point> points);
/// Throws std::runtime_error naming the file when it cannot be read or does not hold exactly `n` points.
std::vector<Point> read_points_file(const std::filesystem::path& path, std::size_t n);

/// The bytes of a file, or the reason why they cannot be had as std::runtime_error. Only regular files of at
/// most `max_bytes`.
std::vector<std::uint8_t> read_bytes(const std::filesystem::path& path, std::size_t max_bytes);
/// Writes a file anew. Throws std::runtime_error naming the file and the system's reason.
void write_bytes(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);

/// `text` as it can stand in a one-line message: control characters become spaces, bytes that are not ASCII
/// `?`, and of more than `max_size` characters the last ones are kept.
std::string printable(std::string_view text, std::size_t max_size);

}  // namespace hullbench
