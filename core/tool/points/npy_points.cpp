#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

#include "tool/points/huge_pages.hpp"
#include "tool/points/numbers.hpp"
#include "tool/points/readers.hpp"

namespace polylidar::tool::point_files {
namespace {

constexpr std::size_t kLongestHeader = std::size_t{1} << 20U;
constexpr std::size_t kValuesABlock = std::size_t{1} << 16U;
constexpr const char* kSaveIt = "; save it with numpy.save(FILE, points) from an array of shape (n, 2)";

struct Array {
  Scalar type;
  bool fortran_order = false;
  std::uint64_t count = 0;
  std::size_t columns = 0;

  std::uint64_t bytes() const { return count * columns * type.size; }
};

/// The text that the array's header has behind 'key':, up to the end.
std::string_view value_of(std::string_view header, const std::string& key, const BlockReader& reader) {
  const std::string label = "'" + key + "':";
  const std::size_t found = header.find(label);
  if (found == std::string_view::npos) reader.fail("its NumPy header has no '" + key + "'" + kSaveIt);
  return trimmed(header.substr(found + label.size()));
}

/// NumPy's name of a type: byte order, kind, size, such as <f8.
Scalar scalar_of(std::string_view name, const BlockReader& reader) {
  const std::size_t size = name.size() == 3 ? static_cast<std::size_t>(name[2] - '0') : 0;
  const bool has_order =
      name.starts_with('<') || name.starts_with('>') || (name.starts_with('|') && size == 1);
  const char kind = has_order && name.size() == 3 ? name[1] : '?';
  const bool whole = (kind == 'i' || kind == 'u') && (size == 1 || size == 2 || size == 4 || size == 8);
  if (!whole && !(kind == 'f' && (size == 4 || size == 8))) {
    reader.fail("its NumPy type " + in_quotes(name) +
                " is no plain number; save points.astype('float64') instead");
  }
  return {kind == 'f'   ? Scalar::Kind::kFloat
          : kind == 'i' ? Scalar::Kind::kSigned
                        : Scalar::Kind::kUnsigned,
          size, name[0] == '>'};
}

/// (n, 2) or (n, 3).
void parse_shape(std::string_view text, Array& array, const BlockReader& reader) {
  const std::size_t comma = text.find(',');
  const std::size_t end = text.find(')');
  if (text.starts_with('(') && comma < end && end != std::string_view::npos) {
    const auto count = parse_count(trimmed(text.substr(1, comma - 1)));
    const auto columns = parse_count(trimmed(text.substr(comma + 1, end - comma - 1)));
    // Below 2^56 points no product of these with a size can overflow.
    if (count && columns && *count >> 56U == 0 && (*columns == 2 || *columns == 3)) {
      array.count = *count;
      array.columns = static_cast<std::size_t>(*columns);
      return;
    }
  }
  reader.fail("its NumPy shape is " + in_quotes(text.substr(0, std::min(end, text.size() - 1) + 1)) +
              " and not (n, 2) or (n, 3); save points.reshape(-1, 2), or points.T when x and y are rows");
}

std::string read_header(BlockReader& reader) {
  char start[8];
  if (!reader.read(start, sizeof start) || std::string_view(start, 6) != "\x93NUMPY") {
    reader.fail(std::string("it does not begin as a NumPy file does") + kSaveIt);
  }
  const int version = static_cast<unsigned char>(start[6]);
  if (version < 1 || version > 3) {
    reader.fail("it is of version " + std::to_string(version) +
                " of NumPy's format, and 1, 2 and 3 are known" + kSaveIt);
  }
  const Scalar length_type{Scalar::Kind::kUnsigned, version == 1 ? std::size_t{2} : std::size_t{4}};
  char length_bytes[4];
  if (!reader.read(length_bytes, length_type.size))
    reader.fail(std::string("its NumPy header is cut short") + kSaveIt);
  const auto length = static_cast<std::size_t>(load(length_bytes, length_type));
  if (length > kLongestHeader) reader.fail(std::string("its NumPy header is absurdly long") + kSaveIt);
  std::string header(length, '\0');
  if (!reader.read(header.data(), length))
    reader.fail(std::string("its NumPy header is cut short") + kSaveIt);
  return header;
}

Array parse_header(const std::string& header, const BlockReader& reader) {
  Array array;
  const std::string_view type = value_of(header, "descr", reader);
  if (!type.starts_with('\'')) {
    reader.fail("its NumPy array has a structured type; save an array of plain numbers of shape (n, 2)");
  }
  array.type = scalar_of(type.substr(1, type.find('\'', 1) - 1), reader);
  array.fortran_order = value_of(header, "fortran_order", reader).starts_with("True");
  parse_shape(value_of(header, "shape", reader), array, reader);
  return array;
}

[[noreturn]] void fail_short(const Array& array, const BlockReader& reader) {
  reader.fail("it ends before the " + std::to_string(array.count) +
              " points that its header promises; it was cut short, so copy or save it again");
}

/// Makes room for the values [done, done + size), which are about to be read: at once when the file was seen
/// to hold them all, else bit by bit, so that a header alone cannot ask for all memory.
void grow(std::vector<Point>& points, std::uint64_t needed, std::uint64_t count, bool size_known) {
  if (points.size() >= needed) return;
  const std::uint64_t size =
      size_known ? count : std::min(count, std::max(needed, 2 * std::uint64_t{points.size()}));
  if (size_known) reserve_points(points, static_cast<std::size_t>(size));
  points.resize(static_cast<std::size_t>(size));
}

/// Whether its bytes are those of points in memory.
bool is_plain(const Array& array) {
  return array.type.kind == Scalar::Kind::kFloat && array.type.size == 8 && !array.type.big_endian &&
         std::endian::native == std::endian::little && array.columns == 2 && !array.fortran_order;
}

void check_finite(const Point& point, std::uint64_t index, const BlockReader& reader) {
  if (std::isfinite(point.x) && std::isfinite(point.y)) return;
  reader.fail("point " + std::to_string(index + 1) +
              " has a coordinate that is not finite; remove such points before saving");
}

/// The next points, from number `first` on, that are x and y one behind the other as doubles: what memory
/// has, too.
void read_plain(BlockReader& reader, const Array& array, std::uint64_t first, std::span<Point> points) {
  static_assert(sizeof(Point) == 2 * sizeof(double));
  if (!reader.read(reinterpret_cast<char*>(points.data()), points.size_bytes())) fail_short(array, reader);
  if (are_finite(points)) return;
  for (std::size_t i = 0; i < points.size(); ++i) check_finite(points[i], first + i, reader);
}

void read_as_they_are(BlockReader& reader, const Array& array, bool size_known, std::vector<Point>& points) {
  for (std::uint64_t done = 0; done < array.count;) {
    const std::uint64_t size = std::min<std::uint64_t>(kValuesABlock, array.count - done);
    grow(points, done + size, array.count, size_known);
    read_plain(reader, array, done, std::span(points).subspan(done, size));
    done += size;
  }
}

/// Calls `use` with the index and the place of each of the next records of `size` bytes, from number `first`
/// to the one before `end`.
template <class Use>
void for_each_record(BlockReader& reader, const Array& array, std::uint64_t first, std::uint64_t end,
                     std::size_t size, const Use& use) {
  std::vector<char> block(kValuesABlock * size);
  for (std::uint64_t done = first; done < end;) {
    const std::uint64_t part = std::min<std::uint64_t>(kValuesABlock, end - done);
    if (!reader.read(block.data(), static_cast<std::size_t>(part) * size)) fail_short(array, reader);
    for (std::size_t i = 0; i < part; ++i) use(done + i, block.data() + i * size);
    done += part;
  }
}

void read_rows(BlockReader& reader, const Array& array, bool size_known, std::vector<Point>& points) {
  const std::size_t size = array.type.size;
  for_each_record(reader, array, 0, array.count, array.columns * size, [&](std::uint64_t i, const char* row) {
    grow(points, i + 1, array.count, size_known);
    points[i] = {load(row, array.type), load(row + size, array.type)};
    check_finite(points[i], i, reader);
  });
}

void hand_on_rows(BlockReader& reader, const Array& array, PointFile& file) {
  const PointFileOptions& options = reader.options();
  if (array.fortran_order) {
    reader.fail(
        "its NumPy array is in Fortran order, x and y apart, which cannot be streamed; save "
        "numpy.ascontiguousarray(points)");
  }
  const std::size_t size = array.type.size;
  const std::uint64_t first = options.part.begin(array.count);
  const std::uint64_t end = options.part.end(array.count);
  const auto skip_rows = [&](std::uint64_t rows) {
    if (!reader.skip(rows * array.columns * size)) fail_short(array, reader);
  };
  skip_rows(first);
  if (is_plain(array) && !options.window) {
    // Small blocks stay in the cache of the one core that works on them; large ones are worth sharing.
    const std::uint64_t in_block = options.part.count > 1 ? kValuesABlock / 8 : kValuesABlock;
    for (std::uint64_t done = first; done < end; done += file.points.size()) {
      file.points.resize(static_cast<std::size_t>(std::min(in_block, end - done)));
      read_plain(reader, array, done, file.points);
      if (!file.points.empty()) options.take_points(file.points);
    }
    file.points.clear();
    return skip_rows(array.count - end);
  }
  for_each_record(reader, array, first, end, array.columns * size, [&](std::uint64_t i, const char* row) {
    const Point point = {load(row, array.type), load(row + size, array.type)};
    check_finite(point, i, reader);
    if (options.window && !is_inside(point, *options.window)) return;
    file.points.push_back(point);
    hand_on(file, options);
  });
  hand_on(file, options, true);
  skip_rows(array.count - end);
}

void read_columns_of_array(BlockReader& reader, const Array& array, bool size_known,
                           std::vector<Point>& points) {
  for_each_record(reader, array, 0, array.count, array.type.size, [&](std::uint64_t i, const char* value) {
    grow(points, i + 1, array.count, size_known);
    points[i].x = load(value, array.type);
  });
  for_each_record(reader, array, 0, array.count, array.type.size, [&](std::uint64_t i, const char* value) {
    points[i].y = load(value, array.type);
    check_finite(points[i], i, reader);
  });
  if (array.columns == 3 && !reader.skip(array.count * array.type.size)) fail_short(array, reader);
}

}  // namespace

void read_npy(BlockReader& reader, PointFile& file) {
  const Array array = parse_header(read_header(reader), reader);
  const std::optional<std::uint64_t> remaining = reader.remaining();
  if (remaining && *remaining < array.bytes()) fail_short(array, reader);
  std::vector<Point>& points = file.points;
  const bool is_streamed =
      reader.options().take_points && !(array.fortran_order && reader.options().whole_if_needed);
  if (is_streamed) {
    hand_on_rows(reader, array, file);
  } else if (array.fortran_order) {
    read_columns_of_array(reader, array, remaining.has_value(), points);
  } else if (is_plain(array)) {
    read_as_they_are(reader, array, remaining.has_value(), points);
  } else {
    read_rows(reader, array, remaining.has_value(), points);
  }
  if (reader.peek() != BlockReader::kEnd) {
    reader.fail("more bytes follow the " + std::to_string(array.count) + " points of its header" + kSaveIt);
  }
  if (!is_streamed) points.resize(static_cast<std::size_t>(array.count));
}

}  // namespace polylidar::tool::point_files
