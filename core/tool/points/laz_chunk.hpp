// The points of one chunk of a LAZ file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace polylidar::tool::point_files {

/// What a point record has, and what of it is wanted.
struct LazRecordLayout {
  bool is_layered = false;  ///< point formats 6 to 8, attribute by attribute; else 0 to 3, point by point
  bool has_time = false;    ///< of formats 0 to 3; the others have it always
  bool has_colour = false;
  bool has_infrared = false;    ///< of formats 6 to 8, and colour with it
  std::size_t extra_bytes = 0;  ///< behind what the format has
  bool wants_source = false;    ///< of formats 6 to 8, which need not unpack it

  /// Bytes of a point record as LAS has it.
  std::size_t record_size() const;
};

/// Unpacks chunks, one after the other.
class ChunkDecoder {
 public:
  virtual ~ChunkDecoder() = default;

  /// Begins with a chunk of `count` points, 1 or more; `bytes` must stay until the last point is read.
  /// Returns false if these bytes cannot be such a chunk.
  virtual bool start(std::span<const unsigned char> bytes, std::uint64_t count) = 0;
  /// The next points of the chunk as LAS records of kUnpackedSize bytes each: x, y, the returns, the class,
  /// the flags, and the point source if it is wanted. What else a record has may be anything. Returns false
  /// if the chunk ended too early or is damaged.
  virtual bool read(char* records, std::size_t count) = 0;

  static constexpr std::size_t kUnpackedSize = 24;
};

std::unique_ptr<ChunkDecoder> make_chunk_decoder(const LazRecordLayout& layout);

}  // namespace polylidar::tool::point_files
