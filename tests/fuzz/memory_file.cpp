#include "tests/fuzz/memory_file.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>

namespace polylidar::fuzz {
namespace {

bool is_utf8(std::string_view text) {
  try {
    static_cast<void>(nlohmann::json(text).dump());
    return true;
  } catch (const nlohmann::json::type_error&) {
    return false;
  }
}

void write_to(int file, std::string_view bytes) {
  expect(::write(file, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()),
         "no room for the input");
}

}  // namespace

void expect(bool holds, const char* what) {
  if (holds) return;
  std::cerr << "FAILED: " << what << std::endl;
  std::abort();
}

MemoryFile::MemoryFile(std::string_view bytes, bool as_pipe) {
  std::array<int, 2> ends{};
  if (as_pipe && bytes.size() < 60000 && ::pipe(ends.data()) == 0) {
    file_ = ends[0];
    write_to(ends[1], bytes);
    ::close(ends[1]);
  } else {
    file_ = ::memfd_create("input", 0);
    write_to(file_, bytes);
  }
}

MemoryFile::~MemoryFile() {
  ::close(file_);
}

void check_refusal(const std::exception& error, const MemoryFile& file) {
  const std::string_view what = error.what();
  expect(what.find(file.path()) != std::string_view::npos, "a refusal does not name the file");
  const auto is_shown = [](char c) { return static_cast<unsigned char>(c) >= ' ' && c != '\x7F'; };
  expect(std::all_of(what.begin(), what.end(), is_shown) && is_utf8(what),
         "a refusal is not one line of plain text");
}

}  // namespace polylidar::fuzz
