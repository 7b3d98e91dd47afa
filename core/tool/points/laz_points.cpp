// Source of the format: ASPRS, "LAZ Specification" 1.4.
#include "tool/points/laz_points.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "tool/points/arithmetic_decoder.hpp"
#include "tool/program/little_endian.hpp"

namespace polylidar::tool::point_files {
namespace {

constexpr const char* kConvert = "; convert it, as in 'pdal translate in.laz out.las'";

constexpr std::uint32_t kVariable = ~0U;  ///< as the size of chunks: each has its own

// Places in the record "laszip encoded", bytes.
constexpr std::size_t kCompressor = 0;
constexpr std::size_t kCoder = 2;
constexpr std::size_t kChunkSize = 12;
constexpr std::size_t kItemCount = 32;
constexpr std::size_t kItems = 34;  // each a kind, bytes and a version of 2 bytes

enum Compressor : std::uint64_t {
  kPointwiseCompressor = 1,
  kPointwiseChunkedCompressor = 2,
  kLayeredCompressor = 3
};

enum ItemKind : std::uint64_t {
  kBytesItem = 0,
  kPoint10Item = 6,
  kTimeItem = 7,
  kColourItem = 8,
  kPoint14Item = 10,
  kColour14Item = 11,
  kInfrared14Item = 12,
  kBytes14Item = 14
};

struct Item {
  std::uint64_t kind = 0;
  std::uint64_t size = 0;
  std::uint64_t version = 0;
};

/// The number at `place`; 0 where there are fewer bytes.
template <class Whole>
Whole number_in(std::string_view bytes, std::size_t place) {
  return place + sizeof(Whole) <= bytes.size() ? whole_at<Whole>(bytes.data() + place) : Whole{0};
}

std::vector<Item> items_of(std::string_view record) {
  std::vector<Item> items(number_in<std::uint16_t>(record, kItemCount));
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::size_t place = kItems + 6 * i;
    items[i] = {number_in<std::uint16_t>(record, place), number_in<std::uint16_t>(record, place + 2),
                number_in<std::uint16_t>(record, place + 4)};
  }
  return items;
}

/// What the points of a format consist of.
LazRecordLayout layout_of(unsigned format, bool wants_source) {
  LazRecordLayout layout;
  layout.is_layered = format >= 6;
  layout.has_time = format == 1 || format == 3;
  layout.has_colour = format == 2 || format == 3 || format == 7 || format == 8;
  layout.has_infrared = format == 8;
  layout.wants_source = wants_source;
  return layout;
}

/// The kinds of items that points of this layout have, in their order.
std::vector<std::uint64_t> kinds_of(const LazRecordLayout& layout) {
  std::vector<std::uint64_t> kinds = {layout.is_layered ? kPoint14Item : kPoint10Item};
  if (layout.has_time) kinds.push_back(kTimeItem);
  if (layout.has_colour) {
    kinds.push_back(!layout.is_layered ? kColourItem : layout.has_infrared ? kInfrared14Item : kColour14Item);
  }
  if (layout.extra_bytes > 0) kinds.push_back(layout.is_layered ? kBytes14Item : kBytesItem);
  return kinds;
}

}  // namespace

bool is_laz_record(std::string_view user, std::uint64_t id) {
  constexpr std::uint64_t kLazRecord = 22204;
  return id == kLazRecord && user.starts_with("laszip encoded");
}

LazPoints::LazPoints(BlockReader& reader, const LazHeader& header, std::string_view record, bool wants_source)
    : reader_(reader), points_at_(header.points_at), count_(header.count) {
  find_layout(header, record, wants_source);
  if (count_ == 0) return;
  find_end();
  find_chunks();
  decoder_ = make_chunk_decoder(layout_);
}

/// Refuses what is not known here. The items must be those of the point format, so they say no more than how
/// many bytes are behind these.
void LazPoints::find_layout(const LazHeader& header, std::string_view record, bool wants_source) {
  if (record.empty()) {
    reader_.fail(
        "its LAS header says that the points are compressed, but no record \"laszip encoded\" says how; copy "
        "or save the file again");
  }
  if (header.format == 4 || header.format == 5 || header.format > 8) {
    reader_.fail("it is a LAZ file with waveforms, which are not unpacked here" + std::string(kConvert));
  }
  const std::uint64_t compressor = number_in<std::uint16_t>(record, kCompressor);
  if (compressor < kPointwiseCompressor || compressor > kLayeredCompressor ||
      number_in<std::uint16_t>(record, kCoder) != 0) {
    reader_.fail("it is a LAZ file with compressor " + std::to_string(compressor) + " and coder " +
                 std::to_string(number_in<std::uint16_t>(record, kCoder)) +
                 ", and 1 to 3 with coder 0 are known" + kConvert);
  }
  layout_ = layout_of(header.format, wants_source);
  layout_.extra_bytes = header.point_size - std::min(layout_.record_size(), header.point_size);
  const std::vector<std::uint64_t> kinds = kinds_of(layout_);
  const std::vector<Item> items = items_of(record);
  std::uint64_t size = 0;
  for (const Item& item : items) size += item.size;
  const bool is_known = std::equal(items.begin(), items.end(), kinds.begin(), kinds.end(),
                                   [](const Item& item, std::uint64_t kind) { return item.kind == kind; });
  if (!is_known || size != header.point_size || layout_.record_size() != header.point_size ||
      layout_.is_layered != (compressor == kLayeredCompressor)) {
    reader_.fail("it is a LAZ file whose record \"laszip encoded\" does not fit point format " +
                 std::to_string(header.format) + " with " + std::to_string(header.point_size) +
                 " bytes a point" + kConvert);
  }
  for (const Item& item : items) {
    // What differs between versions 3 and 4 are layers that are passed over here.
    if (layout_.is_layered ? item.version == 3 || item.version == 4 : item.version == 2) continue;
    reader_.fail("it is a LAZ file with items of version " + std::to_string(item.version) + ", and " +
                 (layout_.is_layered ? "3 and 4 are" : "2 is") + " known for its point format" + kConvert);
  }
  has_chunks_ = compressor != kPointwiseCompressor;
  chunk_size_ = number_in<std::uint32_t>(record, kChunkSize);
  if (chunk_size_ == 0) chunk_size_ = kVariable;  // as LASzip has it
}

/// Where the file ends. A pipe is read into memory, as what is at its end says where the chunks are.
void LazPoints::find_end() {
  const std::optional<std::uint64_t> remaining = reader_.remaining();
  is_in_memory_ = !remaining;
  if (is_in_memory_) {
    for (std::string_view block = reader_.ahead(); !block.empty(); block = reader_.ahead()) {
      rest_.insert(rest_.end(), block.begin(), block.end());
      reader_.skip(block.size());
    }
  }
  end_ = points_at_ + remaining.value_or(rest_.size());
}

void LazPoints::find_chunks() {
  if (!has_chunks_) {
    chunks_ = {{0, points_at_, end_ - points_at_}};
    return;
  }
  constexpr std::size_t kTablePlace = 8;  // bytes in front of the chunks that say where the table is
  if (end_ - points_at_ < kTablePlace) fail_short();
  read_table(find_table(), points_at_ + kTablePlace);
}

/// Where the table of chunks is.
std::uint64_t LazPoints::find_table() const {
  std::array<unsigned char, 8> place{};
  read_bytes(points_at_, place);
  // A program that could not go back there wrote the place to the end of the file.
  constexpr std::uint64_t kAtEnd = ~std::uint64_t{0};
  if (whole_at<std::uint64_t>(place.data()) == kAtEnd) read_bytes(end_ - place.size(), place);
  const auto table_at = whole_at<std::uint64_t>(place.data());
  if (table_at == points_at_) {
    reader_.fail(
        "it is a LAZ file without the table of its chunks, as its writing was interrupted; write it again");
  }
  return table_at;
}

/// The table: a version and the number of chunks, and then how many bytes each has, and how many points, if
/// chunks differ in these.
void LazPoints::read_table(std::uint64_t table_at, std::uint64_t chunks_at) {
  std::array<unsigned char, 8> start{};
  if (table_at < chunks_at || table_at > end_ || end_ - table_at < start.size()) fail_short();
  read_bytes(table_at, start);
  const std::uint64_t bytes_of_chunks = table_at - chunks_at;
  const std::uint64_t count = whole_at<std::uint32_t>(&start[4]);
  if (whole_at<std::uint32_t>(start.data()) != 0 || count > bytes_of_chunks) fail_at_table();
  constexpr std::uint64_t kMostForChunk = 16;  // of the table's bytes, more than enough
  bytes_.resize(
      static_cast<std::size_t>(std::min(end_ - table_at - start.size(), kMostForChunk * (count + 1))));
  read_bytes(table_at + start.size(), bytes_);
  ArithmeticDecoder decoder;
  decoder.start(bytes_);
  IntegerDecoder numbers(32, 2);
  std::uint32_t points = chunk_size_ == kVariable ? 0 : chunk_size_;
  std::uint32_t size = 0;
  std::uint64_t first_point = 0;
  std::uint64_t begin = chunks_at;
  for (std::uint64_t i = 0; i < count && first_point < count_; ++i) {
    if (chunk_size_ == kVariable) points = numbers.number(decoder, points, 0);
    size = numbers.number(decoder, size, 1);
    if (decoder.is_broken() || size > table_at - begin) fail_at_table();
    if (points > 0) {
      if (size < layout_.record_size()) fail_at_table();
      chunks_.push_back({first_point, begin, size});
    }
    first_point += points;
    begin += size;
  }
  if (first_point < count_) fail_short();
}

std::uint64_t LazPoints::end_of(std::size_t chunk) const {
  return chunk + 1 < chunks_.size() ? chunks_[chunk + 1].first_point : count_;
}

void LazPoints::choose(const FilePart& part) {
  const auto begins_before = [](const Chunk& chunk, std::uint64_t point) {
    return chunk.first_point < point;
  };
  const auto chunk_at = [&](std::uint64_t point) {
    return std::lower_bound(chunks_.begin(), chunks_.end(), point, begins_before) - chunks_.begin();
  };
  next_chunk_ = static_cast<std::size_t>(chunk_at(part.begin(count_)));
  const auto end = static_cast<std::size_t>(chunk_at(part.end(count_)));
  left_ = next_chunk_ < end ? end_of(end - 1) - chunks_[next_chunk_].first_point : 0;
}

void LazPoints::read(char* records, std::size_t count) {
  while (count > 0) {
    if (left_in_chunk_ == 0) begin_chunk();
    const auto now = static_cast<std::size_t>(std::min<std::uint64_t>(count, left_in_chunk_));
    if (!decoder_->read(records, now)) fail_at_chunk();
    reader_.tell_progress();  // a chunk may be all of the file
    records += now * ChunkDecoder::kUnpackedSize;
    count -= now;
    left_ -= now;
    left_in_chunk_ -= now;
  }
}

void LazPoints::begin_chunk() {
  const Chunk& chunk = chunks_[next_chunk_];
  left_in_chunk_ = end_of(next_chunk_) - chunk.first_point;
  ++next_chunk_;
  bytes_.resize(static_cast<std::size_t>(chunk.size));
  read_bytes(chunk.begin, bytes_);
  if (!decoder_->start(bytes_, left_in_chunk_)) fail_at_chunk();
}

std::string_view LazPoints::from(std::uint64_t place) const {
  if (place < points_at_ || place >= end_) return {};
  const auto begin = static_cast<std::size_t>(place - points_at_);
  return {reinterpret_cast<const char*>(rest_.data()) + begin, rest_.size() - begin};
}

/// The bytes at `place`, which are between the first point and the end.
void LazPoints::read_bytes(std::uint64_t place, std::span<unsigned char> to) const {
  if (is_in_memory_) {
    const auto from = rest_.begin() + static_cast<std::ptrdiff_t>(place - points_at_);
    std::copy_n(from, to.size(), to.begin());
  } else if (!reader_.read_at(place, reinterpret_cast<char*>(to.data()), to.size())) {
    fail_short();
  }
}

void LazPoints::fail_short() const {
  reader_.fail("it ends before the " + std::to_string(count_) +
               " points that its header promises; it was cut short, so copy or save it again");
}

void LazPoints::fail_at_table() const {
  reader_.fail("the table of its compressed points is damaged; copy or save the file again");
}

void LazPoints::fail_at_chunk() const {
  const std::size_t chunk = next_chunk_ - 1;
  reader_.fail("its compressed points " + std::to_string(chunks_[chunk].first_point + 1) + " to " +
               std::to_string(end_of(chunk)) + " are damaged; copy or save the file again");
}

}  // namespace polylidar::tool::point_files
