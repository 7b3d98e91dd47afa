#include "benchmarks/base/files.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "tool/program/result_output.hpp"

namespace hullbench {

std::optional<std::string> read_text_file(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in.is_open() || fs::is_directory(path)) return std::nullopt;
  try {
    return std::string(std::istreambuf_iterator<char>(in), {});
  } catch (const std::ios_base::failure& error) {
    throw std::runtime_error("cannot read " + path.string() + ": " + error.code().message());
  }
}

std::string required_text(const fs::path& path) {
  if (std::optional<std::string> text = read_text_file(path)) return std::move(*text);
  throw ConfigurationError("Cannot read " + path.string() + ".");
}

void write_text_file(const fs::path& path, const std::string& text) {
  polylidar::tool::write_result(path.string(), text);
}

std::string dump_text(const json& content, int indent) {
  return content.dump(indent, ' ', false, json::error_handler_t::replace);
}

void write_json_file(const fs::path& path, const json& content) {
  write_text_file(path, dump_text(content, 2) + "\n");
}

ConfigurationError not_writable(const fs::path& folder, const std::string& why) {
  // NOLINTNEXTLINE(modernize-return-braced-init-list): the inherited constructor is explicit
  return ConfigurationError("cannot write to the output folder " + folder.string() + " (" + why +
                            "); choose another one with --out");
}

void make_writable_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error && ::faccessat(AT_FDCWD, folder.c_str(), W_OK | X_OK, AT_EACCESS) != 0) {
    error.assign(errno, std::generic_category());
  }
  if (error) throw not_writable(folder, error.message());
}

}  // namespace hullbench
