#include "benchmarks/record/xz_file.hpp"

#include <lzma.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/files.hpp"

namespace hullbench::record {

std::string read_xz_file(const std::filesystem::path& path) {
  constexpr std::size_t kMaxBytes = std::size_t{1} << 30;
  const std::string compressed = required_text(path);
  lzma_stream stream = LZMA_STREAM_INIT;
  const std::unique_ptr<lzma_stream, void (*)(lzma_stream*)> owner(&stream, &lzma_end);
  lzma_ret state = lzma_stream_decoder(&stream, std::numeric_limits<std::uint64_t>::max(), LZMA_CONCATENATED);
  stream.next_in = reinterpret_cast<const std::uint8_t*>(compressed.data());
  stream.avail_in = compressed.size();
  std::string content;
  std::array<char, 65536> chunk{};
  while (state == LZMA_OK) {
    stream.next_out = reinterpret_cast<std::uint8_t*>(chunk.data());
    stream.avail_out = chunk.size();
    state = lzma_code(&stream, LZMA_FINISH);
    content.append(chunk.data(), chunk.size() - stream.avail_out);
    if (content.size() > kMaxBytes) throw ConfigurationError(path.string() + " holds more than 1 GiB.");
  }
  if (state != LZMA_STREAM_END) {
    throw ConfigurationError(path.string() + " is not a whole xz file; get it anew.");
  }
  return content;
}

}  // namespace hullbench::record
