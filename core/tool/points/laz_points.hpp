// The points of a LAZ file: which chunks there are, and the points of those that are asked for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tool/points/block_reader.hpp"
#include "tool/points/laz_chunk.hpp"

namespace polylidar::tool::point_files {

/// What the header of a LAZ file says of its points.
struct LazHeader {
  unsigned format = 0;         ///< without the bits that say that it is compressed
  std::size_t point_size = 0;  ///< bytes, before they were compressed
  std::uint64_t points_at = 0;
  std::uint64_t count = 0;
};

/// Whether a variable length record of this user and number is the one that every LAZ file has.
bool is_laz_record(std::string_view user, std::uint64_t id);

/// The points in their order. All functions throw PointFileError when the file is none, or damaged.
class LazPoints {
 public:
  /// `record`: what the record "laszip encoded" holds. `reader` is where the points begin, and is read to its
  /// end where the file is a pipe. Point sources are unpacked if `wants_source`.
  LazPoints(BlockReader& reader, const LazHeader& header, std::string_view record, bool wants_source);

  /// Goes to the chunks that begin in a part of the file. To be called before any points are read.
  void choose(const FilePart& part);
  /// How many points the chosen chunks have that were not read yet.
  std::uint64_t left() const { return left_; }
  /// The next `count` points, of those that are left, as ChunkDecoder::read() gives them.
  void read(char* records, std::size_t count);

  /// Whether the file was read to its end, as a pipe is, and is kept.
  bool is_in_memory() const { return is_in_memory_; }
  /// Of such a file the bytes from `place` on; none if the points begin behind it.
  std::string_view from(std::uint64_t place) const;

 private:
  struct Chunk {
    std::uint64_t first_point = 0;
    std::uint64_t begin = 0;  ///< in the file
    std::uint64_t size = 0;   ///< bytes
  };

  void find_layout(const LazHeader& header, std::string_view record, bool wants_source);
  void find_end();
  void find_chunks();
  std::uint64_t find_table() const;
  void read_table(std::uint64_t table_at, std::uint64_t chunks_at);
  void begin_chunk();
  std::uint64_t end_of(std::size_t chunk) const;
  void read_bytes(std::uint64_t place, std::span<unsigned char> to) const;
  [[noreturn]] void fail_short() const;
  [[noreturn]] void fail_at_table() const;
  /// In the chunk that is being read.
  [[noreturn]] void fail_at_chunk() const;

  BlockReader& reader_;
  LazRecordLayout layout_;
  std::uint64_t points_at_ = 0;
  std::uint64_t count_ = 0;       ///< of the file's points
  std::uint32_t chunk_size_ = 0;  ///< points; kVariable: as the table says
  bool has_chunks_ = true;        ///< else all points are one
  bool is_in_memory_ = false;
  std::vector<unsigned char> rest_;  ///< of a pipe, from points_at_ on
  std::uint64_t end_ = 0;            ///< of the file
  std::vector<Chunk> chunks_;        ///< one after the other, each with a point or more
  std::size_t next_chunk_ = 0;
  std::uint64_t left_ = 0;            ///< points to read
  std::uint64_t left_in_chunk_ = 0;   ///< of these, those of the chunk that is being read
  std::vector<unsigned char> bytes_;  ///< of that chunk
  std::unique_ptr<ChunkDecoder> decoder_;
};

}  // namespace polylidar::tool::point_files
