#include "tool/points/point_writer.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "tool/program/letter_case.hpp"
#include "tool/program/little_endian.hpp"

namespace polylidar::tool {
namespace {

constexpr std::array<std::pair<std::string_view, PointOutput>, 5> kOutputEndings = {
    {{"csv", PointOutput::kCsv},
     {"xyz", PointOutput::kXyz},
     {"npy", PointOutput::kNpy},
     {"las", PointOutput::kLas},
     {"txt", PointOutput::kXyz}}};

/// `text`, and zeros up to `size` bytes.
void put_text(std::string_view text, std::size_t size, std::string& to) {
  to += text;
  to.append(size - text.size(), '\0');
}

template <class Number>
void put_digits(Number value, std::string& to) {
  std::array<char, 32> digits{};
  to.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
}

/// 10^exponent as the nearest double, which std::pow does not promise; exponent from -300 to 308.
double power_of_ten(int exponent) {
  const std::string text = "1e" + std::to_string(exponent);
  double power = 1;
  std::from_chars(text.data(), text.data() + text.size(), power);
  return power;
}

std::string npy_header(const PointFileFacts& facts) {
  std::string array = "{'descr': '<f8', 'fortran_order': False, 'shape': (" + std::to_string(facts.count) +
                      (facts.has_labels ? ", 3), }" : ", 2), }");
  // What precedes the numbers is a multiple of 64 bytes long, ten of them in front of the text.
  array.append(63 - (array.size() + 10) % 64, ' ');
  array += '\n';
  std::string header = "\x93NUMPY";
  header += '\x01';
  header += '\0';
  put(static_cast<std::uint16_t>(array.size()), header);
  return header + array;
}

constexpr std::uint16_t kLasHeaderSize = 227;
constexpr std::uint16_t kLasPointSize = 20;

/// The public header block (LAS Specification Version 1.2, ASPRS 2008).
std::string las_header(const PointFileFacts& facts, const LasGrid& grid) {
  std::string header = "LASF";
  put(std::uint16_t{0}, header);  // file source
  put(std::uint16_t{0}, header);  // global encoding
  put_text("", 16, header);       // project
  header += '\x01';
  header += '\x02';
  put_text("OTHER", 32, header);  // system that made the points
  put_text("hullbench", 32, header);
  // No date: the same points are the same bytes.
  put(std::uint16_t{0}, header);
  put(std::uint16_t{0}, header);
  put(kLasHeaderSize, header);
  put(std::uint32_t{kLasHeaderSize}, header);  // where the points begin
  put(std::uint32_t{0}, header);               // variable length records
  put(std::uint8_t{0}, header);                // point format
  put(kLasPointSize, header);
  put(static_cast<std::uint32_t>(facts.count), header);
  put(static_cast<std::uint32_t>(facts.count), header);  // first returns
  for (int others = 0; others < 4; ++others) put(std::uint32_t{0}, header);
  for (const double scale : {grid.scale(), grid.scale(), grid.scale()}) put(scale, header);
  for (const double offset : {grid.offset().x, grid.offset().y, 0.0}) put(offset, header);
  const Point low = grid.place(grid.column(facts.bounds.min.x), grid.row(facts.bounds.min.y));
  const Point high = grid.place(grid.column(facts.bounds.max.x), grid.row(facts.bounds.max.y));
  for (const double bound : {high.x, low.x, high.y, low.y, 0.0, 0.0}) put(bound, header);
  return header;
}

void put_las_point(const Point& point, std::uint16_t label, const LasGrid& grid, std::string& to) {
  put(grid.column(point.x), to);
  put(grid.row(point.y), to);
  put(std::int32_t{0}, to);
  put(std::uint16_t{0}, to);  // intensity
  to += '\x09';               // the first of one return
  put_text("", 3, to);        // classification, angle, user data
  put(label, to);
}

}  // namespace

std::optional<PointOutput> point_output_of(const std::string& name) {
  const auto* const found =
      std::find_if(kOutputEndings.begin(), kOutputEndings.end(),
                   [&](const auto& known) { return known.first == name && known.first != "txt"; });
  return found == kOutputEndings.end() ? std::nullopt : std::optional(found->second);
}

std::optional<PointOutput> point_output_of_ending(const std::string& path) {
  const std::string ending = lower_case(std::filesystem::path(path).extension().string());
  const auto* const found =
      std::find_if(kOutputEndings.begin(), kOutputEndings.end(),
                   [&](const auto& known) { return !ending.empty() && ending.substr(1) == known.first; });
  return found == kOutputEndings.end() ? std::nullopt : std::optional(found->second);
}

void check_point_count(PointOutput format, std::uint64_t count) {
  if (format == PointOutput::kLas && count > std::numeric_limits<std::uint32_t>::max()) {
    throw std::invalid_argument(
        "a LAS 1.2 file holds at most 4294967295 points; ask for fewer, or for another format");
  }
}

LasGrid::LasGrid(const Box& bounds)
    // Halves are added, as the sum of two large coordinates may be infinite.
    : offset_{bounds.min.x / 2 + bounds.max.x / 2, bounds.min.y / 2 + bounds.max.y / 2} {
  // One less than what 32 bits hold, for the roundings of the way there.
  constexpr double kReach = std::numeric_limits<std::int32_t>::max() - 1;
  const double reach = std::max(std::max(bounds.max.x - offset_.x, offset_.x - bounds.min.x),
                                std::max(bounds.max.y - offset_.y, offset_.y - bounds.min.y));
  int exponent = -300;
  while (exponent < 308 && !(reach <= kReach * power_of_ten(exponent))) ++exponent;
  // Of points at one place, whose bounds are of no size, any scale will do.
  scale_ = reach > 0 ? power_of_ten(exponent) : 1;
}

std::int32_t LasGrid::nearest(double distance) const {
  return static_cast<std::int32_t>(std::round(distance / scale_));
}

PointEncoder::PointEncoder(PointOutput format, const PointFileFacts& facts)
    : format_(format), facts_(facts), grid_(facts.bounds) {
  check_point_count(format, facts.count);
}

std::string PointEncoder::header() const {
  switch (format_) {
    case PointOutput::kCsv:
      return facts_.has_labels ? "x,y,label\n" : "x,y\n";
    case PointOutput::kXyz:
      return "";
    case PointOutput::kNpy:
      return npy_header(facts_);
    case PointOutput::kLas:
      return las_header(facts_, grid_);
  }
  return "";
}

void PointEncoder::append(const Point& point, std::uint32_t label, std::string& to) const {
  if (format_ == PointOutput::kLas) {
    if (facts_.has_labels && label > std::numeric_limits<std::uint16_t>::max()) {
      throw std::invalid_argument("LAS holds labels up to 65535 only; ask for another format");
    }
    return put_las_point(point, facts_.has_labels ? static_cast<std::uint16_t>(label) : std::uint16_t{0},
                         grid_, to);
  }
  if (format_ == PointOutput::kNpy) {
    put(point.x, to);
    put(point.y, to);
    if (facts_.has_labels) put(static_cast<double>(label), to);
    return;
  }
  const char between = format_ == PointOutput::kCsv ? ',' : ' ';
  put_digits(point.x, to);
  to += between;
  put_digits(point.y, to);
  if (facts_.has_labels) {
    to += between;
    put_digits(label, to);
  }
  to += '\n';
}

}  // namespace polylidar::tool
