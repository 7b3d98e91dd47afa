// Files and folders that are read and written.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/names.hpp"

namespace hullbench {

/// The bytes of a file; none of a folder and where there is nothing to be read. Throws std::runtime_error
/// naming the file when its disk fails.
std::optional<std::string> read_text_file(const fs::path& path);

/// The same; throws ConfigurationError naming the file when there are none.
std::string required_text(const fs::path& path);

/// Writes a file whole or not at all, as the tool writes its results (core/tool/program/result_output.hpp).
/// Throws std::runtime_error naming the file when it cannot be written, and Interrupted when interrupted.
void write_text_file(const fs::path& path, const std::string& text);

/// Writes `content`, indented, as write_text_file does.
void write_json_file(const fs::path& path, const json& content);

/// `content` as text, with U+FFFD for bytes that are no UTF-8; indented by `indent`, or on one line when it
/// is -1.
std::string dump_text(const json& content, int indent);

/// Says that an output folder cannot be written to, and why.
ConfigurationError not_writable(const fs::path& folder, const std::string& why);

/// Makes `folder` where it is not there. Throws ConfigurationError when it cannot be made or written to.
void make_writable_folder(const fs::path& folder);

}  // namespace hullbench
