// What gzip compressed, as it is unpacked.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

namespace polylidar::tool::point_files {

/// What is wrong with the compressed bytes.
class GunzipError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads the members of a gzip file (RFC 1952), one behind the other. Built without zlib it is never
/// available.
class Gunzip {
 public:
  /// Gives up to that many bytes; 0 at the end.
  using Read = std::function<std::size_t(char*, std::size_t)>;

  static bool is_available();

  /// `start` are the first bytes, which have been read already, `read` gives those behind them.
  Gunzip(std::string_view start, Read read);
  ~Gunzip();
  Gunzip(const Gunzip&) = delete;
  Gunzip& operator=(const Gunzip&) = delete;

  /// Up to `size` unpacked bytes; 0 at the end, and where no more are asked for. Throws GunzipError when the
  /// bytes are not what gzip writes, or are cut short.
  std::size_t read(char* to, std::size_t size);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace polylidar::tool::point_files
