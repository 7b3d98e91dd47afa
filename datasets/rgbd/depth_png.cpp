// The PNG side of depth_image.hpp. libpng reports errors by longjmp, which must not pass over an object with
// a destructor: every function that calls setjmp holds plain values only, and what it fills belongs to its
// caller.
#include <png.h>

#include <array>
#include <csetjmp>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "datasets/rgbd/depth_image.hpp"

namespace hullbench {

namespace {

/// A PNG in memory, decoded without any of libpng's conversions.
class PngDecoder {
 public:
  explicit PngDecoder(std::string_view bytes) : rest_(bytes) {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, &on_error, &on_warning);
    if (png_ != nullptr) info_ = png_create_info_struct(png_);
    if (info_ != nullptr) png_set_read_fn(png_, this, &on_read);
  }
  ~PngDecoder() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngDecoder(const PngDecoder&) = delete;
  PngDecoder& operator=(const PngDecoder&) = delete;

  /// False when libpng refused the file; then `reason` tells why.
  bool read_header() {
    if (info_ == nullptr) return false;
    if (setjmp(png_jmpbuf(png_)) != 0) return false;  // NOLINT(cert-err52-cpp): libpng's only way
    png_read_info(png_, info_);
    return true;
  }
  /// After read_header: every row into its place in `rows`, and the check of what follows them.
  bool read_rows(png_bytepp rows) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;  // NOLINT(cert-err52-cpp): libpng's only way
    png_read_image(png_, rows);
    png_read_end(png_, nullptr);
    return true;
  }
  bool is_16_bit_grey() const {
    return png_get_bit_depth(png_, info_) == 16 && png_get_color_type(png_, info_) == PNG_COLOR_TYPE_GRAY;
  }
  std::size_t width() const { return png_get_image_width(png_, info_); }
  std::size_t height() const { return png_get_image_height(png_, info_); }
  const char* reason() const { return reason_.data(); }

 private:
  static void on_error(png_structp png, png_const_charp message) {
    auto& reason = static_cast<PngDecoder*>(png_get_error_ptr(png))->reason_;
    std::strncpy(reason.data(), message, reason.size() - 1);
    png_longjmp(png, 1);
  }
  /// libpng's own handler prints.
  static void on_warning(png_structp, png_const_charp) {}
  static void on_read(png_structp png, png_bytep to, std::size_t count) {
    std::string_view& rest = static_cast<PngDecoder*>(png_get_io_ptr(png))->rest_;
    if (count > rest.size()) png_error(png, "it ends too early");
    std::memcpy(to, rest.data(), count);
    rest.remove_prefix(count);
  }

  std::string_view rest_;  ///< not yet decoded
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  std::array<char, 128> reason_{"out of memory"};
};

std::string read_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  // A folder opens as a file does on Linux, and only reading it fails.
  if (!file || std::filesystem::is_directory(path)) {
    throw std::runtime_error("cannot read " + path.string() + "; check that the file exists and may be read");
  }
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& what) {
  throw std::runtime_error(path.string() + " is not a usable depth image: " + what);
}

std::string size_text(std::size_t width, std::size_t height) {
  return std::to_string(width) + " x " + std::to_string(height) + " pixels";
}

}  // namespace

DepthImage read_depth_png(const std::filesystem::path& path, const Intrinsics& intrinsics) {
  const std::string bytes = read_bytes(path);
  const std::string damaged = "libpng refuses it (";
  const std::string restore = "); give a PNG that is whole";
  PngDecoder decoder(bytes);
  if (!decoder.read_header()) refuse(path, damaged + decoder.reason() + restore);
  if (!decoder.is_16_bit_grey()) refuse(path, "it is not 16-bit grey; save the counts as 16-bit grey");
  const auto width = static_cast<std::size_t>(intrinsics.width);
  const auto height = static_cast<std::size_t>(intrinsics.height);
  if (decoder.width() != width || decoder.height() != height) {
    refuse(path, "it has " + size_text(decoder.width(), decoder.height()) + " and the intrinsics say " +
                     size_text(width, height) + "; give the two of one camera mode");
  }
  // Two bytes a count, the higher one first.
  std::vector<png_byte> stored(2 * width * height);
  std::vector<png_bytep> rows(height);
  for (std::size_t row = 0; row < height; ++row) rows[row] = stored.data() + 2 * width * row;
  if (!decoder.read_rows(rows.data())) refuse(path, damaged + decoder.reason() + restore);
  DepthImage image{.intrinsics = intrinsics, .counts = std::vector<std::uint16_t>(width * height)};
  for (std::size_t i = 0; i < image.counts.size(); ++i) {
    image.counts[i] = static_cast<std::uint16_t>(stored[2 * i] * 256U + stored[2 * i + 1]);
  }
  return image;
}

}  // namespace hullbench
