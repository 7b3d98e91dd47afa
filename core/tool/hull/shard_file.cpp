#include "tool/hull/shard_file.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string_view>

#include "tool/points/block_reader.hpp"
#include "tool/points/point_file.hpp"
#include "tool/program/little_endian.hpp"
#include "tool/program/result_output.hpp"

namespace polylidar::tool {
namespace {

constexpr std::string_view kMagic = "polypart";
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kLongestWkt = std::size_t{1} << 20U;
/// Of a point in the file, at least.
constexpr std::uint64_t kLeastPointBytes = 17;

/// The options that may be given or not, by their bits.
struct OptionField {
  std::uint32_t bit;
  std::optional<double> Options::*limit;
};
constexpr std::array kLimits{OptionField{1, &Options::alpha}, OptionField{2, &Options::max_edge_length},
                             OptionField{4, &Options::max_perimeter}};
constexpr std::uint32_t kSaysFill = 8;
constexpr std::uint32_t kFills = 16;
constexpr std::uint32_t kIsGeographic = 1;
constexpr std::uint32_t kIsGiven = 2;

/// FNV-1a of 64 bits.
class Hash {
 public:
  void add(std::string_view bytes) {
    for (const char byte : bytes) {
      value_ = (value_ ^ static_cast<unsigned char>(byte)) * 0x100000001B3U;
    }
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xCBF29CE484222325U;
};

class Writer {
 public:
  explicit Writer(const std::string& path) : output_(path) {}

  void text(std::string_view bytes) {
    block_ += bytes;
    if (block_.size() >= kBlock) write_block();
  }
  template <class Unsigned>
  void whole(Unsigned value) {
    put(value, block_);
    if (block_.size() >= kBlock) write_block();
  }
  void real(double value) { whole(std::bit_cast<std::uint64_t>(value)); }
  void short_whole(std::uint64_t value) {
    for (; value >= 0x80; value >>= 7U) block_ += static_cast<char>(value | 0x80U);
    block_ += static_cast<char>(value);
  }
  void finish() {
    write_block();
    whole(hash_.value());
    output_.write(block_);
    output_.finish();
  }

 private:
  static constexpr std::size_t kBlock = std::size_t{1} << 20U;

  void write_block() {
    hash_.add(block_);
    output_.write(block_);
    block_.clear();
  }

  ResultOutput output_;
  std::string block_;
  Hash hash_;
};

class Reader {
 public:
  explicit Reader(const std::string& path) : reader_(path, options_) {}

  /// Whether the next bytes are these.
  bool reads(std::string_view expected) {
    std::string text(expected.size(), '\0');
    const bool is_there = reader_.read(text.data(), text.size()) && text == expected;
    hash_.add(text);
    return is_there;
  }
  void bytes(char* to, std::size_t size) {
    if (!reader_.read(to, size)) cut_short();
    hash_.add({to, size});
  }
  template <class Unsigned>
  Unsigned whole() {
    std::array<char, sizeof(Unsigned)> bytes_of_value;
    bytes(bytes_of_value.data(), bytes_of_value.size());
    return whole_at<Unsigned>(bytes_of_value.data());
  }
  double real() { return std::bit_cast<double>(whole<std::uint64_t>()); }
  std::uint64_t short_whole() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
      const auto byte = whole<std::uint8_t>();
      value |= (byte & std::uint64_t{0x7F}) << shift;
      if (byte < 0x80) return value;
    }
    damaged();
  }
  std::string text(std::size_t size) {
    std::string text(size, '\0');
    bytes(text.data(), size);
    return text;
  }
  /// Throws unless the file ends with the hash of what was read.
  void finish() {
    const std::uint64_t right = hash_.value();
    if (whole<std::uint64_t>() != right || reader_.peek() != point_files::BlockReader::kEnd) damaged();
  }

  std::optional<std::uint64_t> remaining() const { return reader_.remaining(); }
  [[noreturn]] void fail(const std::string& what) const { reader_.fail(what); }
  [[noreturn]] void cut_short() const { fail("it is cut short; copy it again, or make its shard again"); }
  [[noreturn]] void damaged() const { fail("it is damaged; copy it again, or make its shard again"); }

 private:
  PointFileOptions options_;
  point_files::BlockReader reader_;
  Hash hash_;
};

void write_options(Writer& writer, const Options& options) {
  std::uint32_t given = 0;
  for (const OptionField& field : kLimits) {
    if (options.*field.limit) given |= field.bit;
  }
  if (options.fill_single_triangles) given |= kSaysFill | (*options.fill_single_triangles ? kFills : 0);
  writer.whole(given);
  for (const OptionField& field : kLimits) writer.real((options.*field.limit).value_or(0));
  writer.real(options.detail);
}

Options read_options(Reader& reader) {
  Options options;
  const auto given = reader.whole<std::uint32_t>();
  for (const OptionField& field : kLimits) {
    const double limit = reader.real();
    if ((given & field.bit) != 0) options.*field.limit = limit;
  }
  if ((given & kSaysFill) != 0) options.fill_single_triangles = (given & kFills) != 0;
  options.detail = reader.real();
  return options;
}

void write_crs(Writer& writer, const Crs& crs) {
  writer.whole(static_cast<std::uint32_t>(crs.epsg));
  writer.whole((crs.is_geographic ? kIsGeographic : 0) | (crs.is_given ? kIsGiven : 0));
  writer.whole(static_cast<std::uint32_t>(crs.wkt.size()));
  writer.text(crs.wkt);
}

Crs read_crs(Reader& reader) {
  Crs crs;
  crs.epsg = static_cast<int>(reader.whole<std::uint32_t>());
  const auto known = reader.whole<std::uint32_t>();
  crs.is_geographic = (known & kIsGeographic) != 0;
  crs.is_given = (known & kIsGiven) != 0;
  const auto length = reader.whole<std::uint32_t>();
  if (length > kLongestWkt) reader.damaged();
  crs.wkt = reader.text(length);
  return crs;
}

void read_points(Reader& reader, std::uint64_t count, StreamShard& shard) {
  if (const std::optional<std::uint64_t> remaining = reader.remaining()) {
    if (count > *remaining / kLeastPointBytes) reader.cut_short();
    shard.points.reserve(count);
    shard.numbers.reserve(count);
    shard.uncertain.reserve(count);
  }
  std::uint64_t next = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t step = reader.short_whole();
    shard.numbers.push_back(next + step / 2);
    shard.uncertain.push_back(static_cast<std::uint8_t>(step % 2));
    next = shard.numbers.back() + 1;
    const double x = reader.real();
    const double y = reader.real();
    shard.points.push_back({x, y});
  }
}

}  // namespace

void write_shard_file(const std::string& path, const ShardFile& file) {
  const StreamShard& shard = file.shard;
  Writer writer(path);
  writer.text(kMagic);
  writer.whole(kVersion);
  writer.whole(shard.shard.number);
  writer.whole(shard.shard.count);
  write_options(writer, shard.options);
  writer.whole(shard.source_points);
  writer.whole(shard.source_checksum);
  for (const Point& corner : {shard.box.min, shard.box.max}) {
    writer.real(corner.x);
    writer.real(corner.y);
  }
  writer.real(shard.cells_per_length);
  writer.whole(std::uint64_t{shard.points.size()});
  write_crs(writer, file.crs);
  std::uint64_t next = 0;
  for (std::size_t i = 0; i < shard.points.size(); ++i) {
    writer.short_whole(2 * (shard.numbers[i] - next) + shard.uncertain[i]);
    next = shard.numbers[i] + 1;
    writer.real(shard.points[i].x);
    writer.real(shard.points[i].y);
  }
  writer.finish();
}

ShardFile read_shard_file(const std::string& path) {
  Reader reader(path);
  if (!reader.reads(kMagic)) {
    reader.fail("it is no part of a hull; 'polylidar hull FILE --stream --shard K/N --out PART' makes parts");
  }
  if (const auto version = reader.whole<std::uint32_t>(); version != kVersion) {
    reader.fail("it is a part of version " + std::to_string(version) + ", and this program reads version " +
                std::to_string(kVersion) + "; use one version of polylidar for all shards and for the merge");
  }
  ShardFile file;
  StreamShard& shard = file.shard;
  shard.shard.number = reader.whole<std::uint32_t>();
  shard.shard.count = reader.whole<std::uint32_t>();
  shard.options = read_options(reader);
  shard.source_points = reader.whole<std::uint64_t>();
  shard.source_checksum = reader.whole<std::uint64_t>();
  for (Point* const corner : {&shard.box.min, &shard.box.max}) {
    corner->x = reader.real();
    corner->y = reader.real();
  }
  shard.cells_per_length = reader.real();
  const auto count = reader.whole<std::uint64_t>();
  file.crs = read_crs(reader);
  read_points(reader, count, shard);
  reader.finish();
  return file;
}

}  // namespace polylidar::tool
