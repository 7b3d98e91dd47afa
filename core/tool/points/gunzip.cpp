#include "tool/points/gunzip.hpp"

#include <stdexcept>
#include <utility>

#ifdef POLYLIDAR_WITH_ZLIB
#include <zlib.h>

#include <algorithm>
#include <limits>
#endif

namespace polylidar::tool::point_files {

#ifdef POLYLIDAR_WITH_ZLIB

struct Gunzip::State {
  Read read;
  std::string packed;
  z_stream stream{};
  bool is_between_members = true;
};

bool Gunzip::is_available() {
  return true;
}

Gunzip::Gunzip(std::string_view start, Read read) : state_(std::make_unique<State>()) {
  state_->read = std::move(read);
  state_->packed = start;
  state_->packed.resize(std::max(start.size(), std::size_t{1} << 16U));
  state_->stream.next_in = reinterpret_cast<Bytef*>(state_->packed.data());
  state_->stream.avail_in = static_cast<uInt>(start.size());
  constexpr int kGzipOnly = 16;
  if (inflateInit2(&state_->stream, kGzipOnly + MAX_WBITS) != Z_OK) throw std::bad_alloc();
}

Gunzip::~Gunzip() {
  inflateEnd(&state_->stream);
}

std::size_t Gunzip::read(char* to, std::size_t size) {
  if (size == 0) return 0;
  z_stream& stream = state_->stream;
  const auto room = static_cast<uInt>(std::min<std::size_t>(size, std::numeric_limits<int>::max()));
  stream.next_out = reinterpret_cast<Bytef*>(to);
  stream.avail_out = room;
  while (stream.avail_out == room) {
    if (stream.avail_in == 0) {
      stream.next_in = reinterpret_cast<Bytef*>(state_->packed.data());
      stream.avail_in = static_cast<uInt>(state_->read(state_->packed.data(), state_->packed.size()));
      if (stream.avail_in == 0) {
        if (state_->is_between_members) return 0;
        throw GunzipError("its gzip stream is cut short; copy or compress it again");
      }
    }
    if (state_->is_between_members) {
      // A stream may be padded with zeros, as gzip takes it.
      while (stream.avail_in > 0 && *stream.next_in == 0) {
        ++stream.next_in;
        --stream.avail_in;
      }
      if (stream.avail_in == 0) continue;
      state_->is_between_members = false;
      inflateReset(&stream);
    }
    const int result = inflate(&stream, Z_NO_FLUSH);
    state_->is_between_members = result == Z_STREAM_END;
    if (result != Z_OK && result != Z_STREAM_END && result != Z_BUF_ERROR) {
      throw GunzipError("its gzip stream is damaged; copy or compress it again");
    }
  }
  return room - stream.avail_out;
}

#else

struct Gunzip::State {};

bool Gunzip::is_available() {
  return false;
}

Gunzip::Gunzip(std::string_view /*start*/, Read /*read*/) {
  throw std::logic_error("this was built without zlib");
}

Gunzip::~Gunzip() = default;

std::size_t Gunzip::read(char* /*to*/, std::size_t /*size*/) {
  return 0;
}

#endif

}  // namespace polylidar::tool::point_files
