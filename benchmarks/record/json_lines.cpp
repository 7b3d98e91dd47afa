#include "benchmarks/record/json_lines.hpp"

#include <stdexcept>
#include <system_error>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/files.hpp"
#include "benchmarks/record/xz_file.hpp"

namespace hullbench::record {
namespace {

json parse_line(const std::string& line, const fs::path& path, std::size_t number) {
  try {
    return json::parse(line);
  } catch (const json::exception&) {
    throw ConfigurationError("line " + std::to_string(number) + " of " + path.string() + " is not JSON; " +
                             kDeleteLine);
  }
}

}  // namespace

JsonLines load_json_lines(const fs::path& path) {
  JsonLines result;
  if (!fs::exists(path)) return result;
  const std::string content = path.extension() == ".xz" ? read_xz_file(path) : required_text(path);
  std::size_t begin = 0;
  std::size_t number = 0;
  for (std::size_t end = content.find('\n'); end != std::string::npos; end = content.find('\n', begin)) {
    ++number;
    const std::string line = content.substr(begin, end - begin);
    if (line.find_first_not_of(" \t\r") != std::string::npos) {
      result.lines.push_back(parse_line(line, path, number));
      result.numbers.push_back(number);
    }
    begin = end + 1;
  }
  result.complete_bytes = begin;
  result.torn = content.substr(begin);
  return result;
}

JsonLinesWriter::JsonLinesWriter(const fs::path& path) : path_(path) {
  const JsonLines existing = load_json_lines(path);
  if (!existing.torn.empty()) {
    std::error_code error;
    fs::resize_file(path, existing.complete_bytes, error);
    if (error) throw std::runtime_error("Cannot write " + path.string() + ": " + error.message() + ".");
  }
  out_.open(path, std::ios::binary | std::ios::app);
  if (!out_)
    throw std::runtime_error("Cannot write " + path.string() + ": is its folder there and writable?");
}

void JsonLinesWriter::append(const json& json) {
  // Method and library messages may hold bytes that are not UTF-8; they are replaced, never a reason to lose
  // a row.
  out_ << dump_text(json, -1) + "\n" << std::flush;
  if (!out_) throw std::runtime_error("Cannot write " + path_.string() + ": is the disk full?");
}

}  // namespace hullbench::record
