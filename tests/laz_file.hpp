// LAS files as LAZ, by an encoder of our own: LASzip's compressors 1 and 2 with items of version 2 (point
// formats 0 to 3), and compressor 3 with items of version 3 (6 to 8). It shares nothing with the decoder.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace hullbench::testing {

struct LazOptions {
  std::uint32_t chunk_size = 50'000;       ///< points
  std::vector<std::uint32_t> chunks = {};  ///< points of each chunk, where they differ
  bool is_chunked = true;                  ///< else compressor 1, which formats 0 to 3 may have
  bool has_table_place_at_end = false;     ///< as of a program that could not go back to write it
};

/// The LAS file `las`, which LasFile::text() made, with all of its records. What its points have in any byte
/// is kept.
std::string compressed(const std::string& las, const LazOptions& options = {});

}  // namespace hullbench::testing
