#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "tool/points/huge_pages.hpp"
#include "tool/points/kept_points.hpp"
#include "tool/points/laz_points.hpp"
#include "tool/points/numbers.hpp"
#include "tool/points/readers.hpp"
#include "tool/program/little_endian.hpp"

namespace polylidar::tool::point_files {
namespace {

// ASPRS LAS Specification, versions 1.0 (2003) to 1.4 R15 (2019): places in the public header block, bytes.
constexpr std::size_t kVersionMinor = 25;
constexpr std::size_t kHeaderSize = 94;
constexpr std::size_t kPointOffset = 96;
constexpr std::size_t kRecordCount = 100;
constexpr std::size_t kPointFormat = 104;
constexpr std::size_t kPointSize = 105;
constexpr std::size_t kLegacyCount = 107;
constexpr std::size_t kScale = 131;
constexpr std::size_t kOffset = 155;
constexpr std::size_t kExtent = 179;           // greatest x, least x, greatest y, least y
constexpr std::size_t kExtendedRecords = 235;  // 1.4 only, as the next two
constexpr std::size_t kExtendedRecordCount = 243;
constexpr std::size_t kCount = 247;
constexpr std::size_t kOldHeader = 227;  // up to 1.2; 1.3 has 8 bytes more, which nobody needs here
constexpr std::size_t kNewHeader = 375;  // 1.4

constexpr std::size_t kFlags = 15;  // in a point, the byte of which one bit says that it is withheld

// Numbers of records of the user LASF_Projection.
constexpr std::uint64_t kWkt = 2112;
constexpr std::uint64_t kGeoKeys = 34735;
constexpr std::uint64_t kGeoKeyTexts = 34737;

constexpr std::size_t kRecordHeader = 54;
constexpr std::size_t kExtendedRecordHeader = 60;

/// More than any point has, and few enough to stay in a core's cache.
constexpr std::size_t kBytesAtOnce = std::size_t{1} << 18U;

/// Point format -> the bytes that a point has at least.
constexpr std::array<std::size_t, 11> kLeastPointSize = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};

/// LASzip sets the top bit of the point format, or the one below.
constexpr unsigned kCompressed = 0xC0;

constexpr const char* kCopyAgain = "; it was cut short, so copy or save it again";

/// How many points the header promises; `bytes` are as many as 1.4 has.
std::uint64_t promised_points(const char* bytes) {
  const std::uint64_t count =
      whole_at<std::uint8_t>(bytes + kVersionMinor) >= 4 ? whole_at<std::uint64_t>(bytes + kCount) : 0;
  return count != 0 ? count : whole_at<std::uint32_t>(bytes + kLegacyCount);
}

Lattice lattice_of(const char* bytes) {
  return {{double_at(bytes + kScale), double_at(bytes + kScale + 8)},
          {double_at(bytes + kOffset), double_at(bytes + kOffset + 8)}};
}

struct LasHeader {
  int minor_version = 0;
  std::uint64_t size = 0;
  std::uint64_t points_at = 0;
  std::uint64_t records = 0;
  unsigned format = 0;
  bool is_compressed = false;
  std::size_t point_size = 0;
  std::uint64_t count = 0;
  Lattice lattice;
  std::uint64_t extended_records_at = 0;  ///< 0: there are none
  std::uint64_t extended_records = 0;
};

/// What of a point record can be chosen by.
struct Attributes {
  unsigned number = 0;   ///< of the return
  unsigned returns = 0;  ///< of the pulse
  unsigned classification = 0;
  unsigned source = 0;
  bool is_withheld = false;
};

class LasReader {
 public:
  LasReader(BlockReader& reader, PointFile& file) : reader_(reader), file_(file) {}

  void read() {
    read_header();
    read_records();
    skip_to(header_.points_at, "the points");
    check_size();
    read_points();
    note_records_behind();
    read_extended_records();
    if (!has_wkt_) file_.crs = crs_of_geokeys(geokeys_, geokey_texts_).value_or(Crs());
    if (!reader_.options().by.empty()) labels_.finish(file_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const { reader_.fail("its LAS header " + what); }

  bool take(char* to, std::size_t size) {
    position_ += size;
    return reader_.read(to, size);
  }

  /// Goes to that place of the file, which is not behind.
  void skip_to(std::uint64_t place, const char* what) {
    if (!reader_.skip(place - position_)) reader_.fail(std::string("it ends before ") + what + kCopyAgain);
    position_ = place;
  }

  void read_header() {
    std::array<char, kNewHeader> bytes{};
    const bool is_whole = take(bytes.data(), kOldHeader);
    if (std::memcmp(bytes.data(), "LASF", 4) != 0) {
      reader_.fail("it does not begin with LASF as a LAS file does; name the right format with --input");
    }
    if (!is_whole) reader_.fail(std::string("its LAS header is not whole") + kCopyAgain);
    header_.minor_version = whole_at<std::uint8_t>(&bytes[kVersionMinor]);
    const int major_version = whole_at<std::uint8_t>(&bytes[kVersionMinor - 1]);
    if (major_version != 1 || header_.minor_version > 4) {
      refuse("says version " + std::to_string(major_version) + "." + std::to_string(header_.minor_version) +
             ", and 1.0 to 1.4 are known; convert it to one of these");
    }
    header_.size = whole_at<std::uint16_t>(&bytes[kHeaderSize]);
    header_.points_at = whole_at<std::uint32_t>(&bytes[kPointOffset]);
    header_.records = whole_at<std::uint32_t>(&bytes[kRecordCount]);
    header_.point_size = whole_at<std::uint16_t>(&bytes[kPointSize]);
    const std::size_t needed = header_.minor_version >= 4 ? kNewHeader : kOldHeader;
    if (header_.size < needed || header_.points_at < header_.size) {
      refuse("says that it has " + std::to_string(header_.size) + " bytes and the points begin at byte " +
             std::to_string(header_.points_at) + ", which cannot be; write the file again");
    }
    if (needed == kNewHeader) {
      if (!take(&bytes[kOldHeader], kNewHeader - kOldHeader)) {
        reader_.fail(std::string("its LAS header is not whole") + kCopyAgain);
      }
      header_.extended_records_at = whole_at<std::uint64_t>(&bytes[kExtendedRecords]);
      header_.extended_records = whole_at<std::uint32_t>(&bytes[kExtendedRecordCount]);
    }
    header_.count = promised_points(bytes.data());
    read_format(whole_at<std::uint8_t>(&bytes[kPointFormat]));
    header_.lattice = lattice_of(bytes.data());
    const auto& [steps, offset_of] = header_.lattice;
    const auto reach = [](double scale, double offset) {
      return std::abs(offset) + std::abs(scale) * 0x1p31;
    };
    const bool is_finite =
        std::isfinite(reach(steps.x, offset_of.x)) && std::isfinite(reach(steps.y, offset_of.y));
    if (!is_finite || steps.x == 0 || steps.y == 0) {
      refuse("has a scale or an offset of x or y that is zero or not finite; write the file again");
    }
  }

  void read_format(unsigned format) {
    header_.is_compressed = (format & kCompressed) != 0;
    format &= ~kCompressed;
    header_.format = format;
    if (format >= kLeastPointSize.size() || header_.point_size < kLeastPointSize[format]) {
      refuse("says point format " + std::to_string(format) + " with " + std::to_string(header_.point_size) +
             " bytes a point; the formats are 0 to 10, each with no fewer bytes than the specification says");
    }
    is_extended_format_ = format >= 6;
  }

  /// The variable length records, of which only those with the coordinate system matter, and the one that
  /// says how points are compressed. Reading stops at a record that reaches into the points; the points are
  /// still read.
  void read_records() {
    skip_to(header_.size, "its header does");
    for (std::uint64_t r = 0; r < header_.records; ++r) {
      if (header_.points_at - position_ < kRecordHeader) return;
      std::array<char, kRecordHeader> start{};
      if (!take(start.data(), start.size())) return;
      const std::uint64_t size = whole_at<std::uint16_t>(&start[20]);
      if (header_.points_at - position_ < size) return;
      if (!read_record(start.data(), size)) return;
    }
  }

  /// Says where bytes follow that look like more points than the header counts, as a program leaves them
  /// that was stopped while it wrote. Waveforms may follow those of formats 4, 5, 9 and 10.
  void note_records_behind() {
    const unsigned format = header_.format;
    const bool may_have_waveforms = format == 4 || format == 5 || format >= 9;
    const std::optional<std::uint64_t> remaining = reader_.remaining();
    if (header_.is_compressed || may_have_waveforms || !remaining) return;
    const std::uint64_t behind = header_.points_at + header_.count * header_.point_size;
    const std::uint64_t end =
        header_.extended_records > 0 ? header_.extended_records_at : position_ + *remaining;
    const std::uint64_t more = end > behind ? (end - behind) / header_.point_size : 0;
    if (more == 0) return;
    file_.note = "its header counts " + std::to_string(header_.count) + " points, and there is room for " +
                 std::to_string(more) + " more behind them, which are left out";
  }

  /// Behind the points, in 1.4: as the others, with a length of 64 bits.
  void read_extended_records() {
    if (header_.extended_records == 0 || has_wkt_) return;
    if (reader_.options().part.number > 0) return;  // the first part says what they say
    // What decodes LAZ has read a pipe to its end.
    if (laz_ && laz_->is_in_memory()) return take_extended_records(laz_->from(header_.extended_records_at));
    if (header_.extended_records_at < position_) return;
    if (!reader_.skip(header_.extended_records_at - position_)) return;
    for (std::uint64_t r = 0; r < header_.extended_records; ++r) {
      std::array<char, kExtendedRecordHeader> start{};
      if (!reader_.read(start.data(), start.size())) return;
      const auto size = whole_at<std::uint64_t>(&start[20]);
      const std::optional<std::uint64_t> left = reader_.remaining();
      if ((left && size > *left) || !read_record(start.data(), size)) return;
    }
  }

  /// The same of `bytes` that begin with them.
  void take_extended_records(std::string_view bytes) {
    for (std::uint64_t r = 0; r < header_.extended_records; ++r) {
      if (bytes.size() < kExtendedRecordHeader) return;
      const char* const start = bytes.data();
      const auto size = whole_at<std::uint64_t>(start + 20);
      bytes.remove_prefix(kExtendedRecordHeader);
      if (size > bytes.size()) return;
      if (is_wanted(start, size)) take_record(start, std::string(bytes.substr(0, size)));
      bytes.remove_prefix(size);
    }
  }

  /// Takes what it needs out of a record of which `start` has been read; false when the file ends in it.
  bool read_record(const char* start, std::uint64_t size) {
    if (!is_wanted(start, size)) {
      position_ += size;
      return reader_.skip(size);
    }
    std::string bytes(static_cast<std::size_t>(size), '\0');
    if (!take(bytes.data(), bytes.size())) return false;
    take_record(start, std::move(bytes));
    return true;
  }

  static std::uint64_t id_of(const char* record) { return whole_at<std::uint16_t>(record + 18); }
  static std::string_view user_of(const char* record) { return {record + 2, 16}; }

  /// Whether a record of `size` bytes that begins with `start` says how the points are compressed, or the
  /// coordinate system.
  bool is_wanted(const char* start, std::uint64_t size) const {
    constexpr std::uint64_t kLongest = std::uint64_t{1} << 20U;
    const std::uint64_t id = id_of(start);
    const bool is_projection =
        user_of(start).starts_with("LASF_Projection") && (id == kWkt || id == kGeoKeys || id == kGeoKeyTexts);
    const bool is_laz = is_laz_record(user_of(start), id) && laz_record_.empty();
    return (is_projection || is_laz) && size <= kLongest;
  }

  /// Takes what a record that is_wanted() says. WKT goes before GeoKeys, as the specification has it for 1.4.
  void take_record(const char* start, std::string bytes) {
    const std::uint64_t id = id_of(start);
    if (is_laz_record(user_of(start), id)) {
      laz_record_ = std::move(bytes);
    } else if (id == kWkt) {
      const std::optional<Crs> crs = crs_of_wkt(std::string_view(bytes).substr(0, bytes.find('\0')));
      if (crs) file_.crs = *crs;
      has_wkt_ |= crs.has_value();
    } else if (id == kGeoKeyTexts) {
      geokey_texts_ = std::move(bytes);
    } else {
      geokeys_.resize(bytes.size() / 2);
      for (std::size_t k = 0; k < geokeys_.size(); ++k) {
        geokeys_[k] = whole_at<std::uint16_t>(&bytes[2 * k]);
      }
    }
  }

  void check_size() const {
    if (header_.is_compressed) return;
    const std::optional<std::uint64_t> remaining = reader_.remaining();
    if (remaining && header_.count > *remaining / header_.point_size) fail_short();
  }

  [[noreturn]] void fail_short() const {
    reader_.fail("it ends before the " + std::to_string(header_.count) + " points that its header promises" +
                 kCopyAgain);
  }

  void read_points() {
    const PointFileOptions& options = reader_.options();
    by_ = by_of(options.by);
    if (by_ != By::kNothing) group_of_value_.assign(std::size_t{1} << 16U, kNoGroup);
    const bool takes_all = takes_all_points(options);
    std::uint64_t left = begin_points(options);
    // Only when the file was seen to hold them all, so that a header alone cannot ask for all memory. Of
    // compressed points that is not seen; few take less than a byte.
    if (takes_all && reader_.remaining() && !options.take_points) {
      reserve_points(file_.points, static_cast<std::size_t>(std::min(left, *reader_.remaining())));
    }
    const bool are_kept = options.keep != nullptr && takes_all && by_ == By::kNothing &&
                          options.keep->begin(left, header_.lattice);
    kept_ = are_kept ? options.keep : nullptr;
    const std::size_t points_a_block = kBytesAtOnce / record_size_;
    std::vector<char> block(points_a_block * record_size_);
    while (left > 0) {
      const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(points_a_block, left));
      take_records(block.data(), count);
      left -= count;
      if (takes_all && by_ == By::kNothing) {
        add_all(block.data(), count);
        hand_on_filled(options, left == 0);
      } else {
        for (std::size_t i = 0; i < count; ++i) add(block.data() + i * record_size_, options);
        hand_on(file_, options);
      }
    }
    if (kept_ != nullptr) kept_->finish();
    hand_on(file_, options, true);
  }

  /// Goes to the first point of the part. Returns how many points the part has.
  std::uint64_t begin_points(const PointFileOptions& options) {
    if (header_.is_compressed) {
      const LazHeader header = {header_.format, header_.point_size, header_.points_at, header_.count};
      laz_.emplace(reader_, header, laz_record_, by_ == By::kSource);
      laz_->choose(options.part);
      record_size_ = ChunkDecoder::kUnpackedSize;
      return laz_->left();
    }
    record_size_ = header_.point_size;
    const std::uint64_t first = options.part.begin(header_.count);
    skip_to(header_.points_at + first * record_size_, "its points do");
    return options.part.end(header_.count) - first;
  }

  /// The next records, of record_size_ bytes each.
  void take_records(char* to, std::size_t count) {
    if (laz_) {
      laz_->read(to, count);
    } else if (!take(to, count * record_size_)) {
      fail_short();
    }
  }

  Attributes attributes_of(const char* record) const {
    const auto byte = [&](std::size_t place) -> unsigned { return whole_at<std::uint8_t>(record + place); };
    if (is_extended_format_) {
      return {byte(14) & 15U, byte(14) >> 4U, byte(16), whole_at<std::uint16_t>(record + 20),
              (byte(15) & 4U) != 0};
    }
    return {byte(14) & 7U, (byte(14) >> 3U) & 7U, byte(15) & 31U, whole_at<std::uint16_t>(record + 18),
            (byte(15) & 128U) != 0};
  }

  static Point point_of(const char* record, const Lattice& lattice) {
    return lattice.at({whole_at<std::int32_t>(record), whole_at<std::int32_t>(record + 4)});
  }

  /// Puts the points of a block but for those that are withheld behind the first `filled_` ones: as add()
  /// does, in a fraction of its time.
  void add_all(const char* block, std::size_t count) {
    if (file_.points.size() < filled_ + count) file_.points.resize(filled_ + count);
    Point* const points = file_.points.data() + filled_;
    const Lattice lattice = header_.lattice;
    const std::size_t size = record_size_;
    for (std::size_t i = 0; i < count; ++i) points[i] = point_of(block + i * size, lattice);
    if (kept_ != nullptr) {
      LatticePoint* const kept = kept_->end();
      for (std::size_t i = 0; i < count; ++i) {
        kept[i] = {whole_at<std::int32_t>(block + i * size), whole_at<std::int32_t>(block + i * size + 4)};
      }
    }
    const std::size_t taken = count_classes(block, count) ? drop_withheld(block, count) : count;
    filled_ += taken;
    if (kept_ != nullptr) kept_->add(taken);
  }

  /// Counts the points of a block by their classes, those that are withheld among them. Returns whether there
  /// are any.
  bool count_classes(const char* block, std::size_t count) {
    // Several counts of each class, as one that is changed again and again waits for itself.
    constexpr std::size_t kCounts = 4;
    std::array<std::array<std::uint32_t, 256>, kCounts> counts{};
    unsigned flags = 0;
    if (is_extended_format_) {
      for (std::size_t i = 0; i < count; ++i) {
        flags |= static_cast<std::uint8_t>(block[i * record_size_ + kFlags]);
      }
    }
    const auto count_in = [&](std::array<std::uint32_t, 256>& some, std::size_t i) {
      const char* const record = block + i * record_size_;
      ++some[static_cast<std::uint8_t>(record[class_at()])];
    };
    std::size_t i = 0;
    for (; i + kCounts <= count; i += kCounts) {
      for (std::size_t k = 0; k < kCounts; ++k) count_in(counts[k], i + k);
    }
    for (; i < count; ++i) count_in(counts[0], i);
    for (const auto& some : counts) {
      for (unsigned c = 0; c < some.size(); ++c) {
        file_.classes[c & class_bits()] += some[c];
        if (!is_extended_format_ && some[c] > 0) flags |= c;  // the same byte
      }
    }
    return (flags & withheld_bit()) != 0;
  }

  /// Of the block whose points were put behind the first `filled_` ones, and behind the kept ones. Returns
  /// how many are left.
  std::size_t drop_withheld(const char* block, std::size_t count) {
    Point* const points = file_.points.data() + filled_;
    LatticePoint* const kept = kept_ != nullptr ? kept_->end() : nullptr;
    std::size_t left = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const char* const record = block + i * record_size_;
      const unsigned is_taken = (static_cast<std::uint8_t>(record[kFlags]) & withheld_bit()) == 0 ? 1 : 0;
      points[left] = points[i];
      if (kept != nullptr) kept[left] = kept[i];
      left += is_taken;
      file_.classes[static_cast<std::uint8_t>(record[class_at()]) & class_bits()] -= 1 - is_taken;
    }
    return left;
  }

  std::size_t class_at() const { return is_extended_format_ ? 16 : 15; }
  std::uint8_t class_bits() const { return is_extended_format_ ? 255 : 31; }
  std::uint8_t withheld_bit() const { return is_extended_format_ ? 4 : 128; }

  /// hand_on() after add_all(). The memory stays as it is, as filling it with zeros takes its time.
  void hand_on_filled(const PointFileOptions& options, bool at_end) {
    if (options.take_points && (filled_ >= points_in_block(options) || at_end)) {
      if (filled_ > 0) options.take_points(std::span(file_.points).first(filled_));
      filled_ = 0;
    }
    if (at_end) file_.points.resize(filled_);
  }

  void add(const char* record, const PointFileOptions& options) {
    const Attributes attributes = attributes_of(record);
    if (attributes.is_withheld) return;
    if (options.returns == Returns::kFirst && attributes.number > 1) return;
    if (options.returns == Returns::kLast && attributes.number < attributes.returns) return;
    if (options.classes && !options.classes->test(attributes.classification)) return;
    const Point point = point_of(record, header_.lattice);
    if (options.window && !is_inside(point, *options.window)) return;
    file_.points.push_back(point);
    ++file_.classes[attributes.classification];
    if (by_ != By::kNothing) file_.groups.push_back(group_of(attributes));
  }

  std::uint32_t group_of(const Attributes& attributes) {
    const unsigned value = by_ == By::kClassification ? attributes.classification
                           : by_ == By::kReturn       ? attributes.number
                                                      : attributes.source;
    std::uint32_t& group = group_of_value_[value];
    if (group == kNoGroup) group = labels_.index_of(std::to_string(value));
    return group;
  }

  enum class By { kNothing, kClassification, kReturn, kSource };
  static constexpr std::uint32_t kNoGroup = 0xFFFFFFFFU;

  By by_of(const std::string& name) const {
    if (name.empty()) return By::kNothing;
    if (name == "classification") return By::kClassification;
    if (name == "return") return By::kReturn;
    if (name == "point_source") return By::kSource;
    reader_.fail("a LAS file has no column " + in_quotes(name) +
                 " to group by; give --by classification, return or point_source");
  }

  BlockReader& reader_;
  PointFile& file_;
  LasHeader header_;
  bool is_extended_format_ = false;
  bool has_wkt_ = false;
  std::vector<std::uint16_t> geokeys_;
  std::string geokey_texts_;
  std::string laz_record_;        ///< that says how the points are compressed
  std::optional<LazPoints> laz_;  ///< of a file whose points are compressed
  std::size_t record_size_ = 0;   ///< bytes from one point to the next, as they are taken
  std::uint64_t position_ = 0;    ///< in the file, as far as it matters
  std::size_t filled_ = 0;        ///< of the file's points, those that add_all() has put there
  KeptPoints* kept_ = nullptr;    ///< where they go as well, if anywhere
  By by_ = By::kNothing;
  std::vector<std::uint32_t> group_of_value_;  ///< a value of 16 bits -> the number of its label, or kNoGroup
  Labels labels_;
};

}  // namespace

bool is_laz(std::string_view start) {
  return start.starts_with("LASF") && start.size() > kPointFormat &&
         (static_cast<unsigned char>(start[kPointFormat]) & kCompressed) != 0;
}

std::optional<std::uint64_t> promised_points_of_las(std::string_view start) {
  if (!start.starts_with("LASF") || start.size() < kNewHeader) return {};
  return promised_points(start.data());
}

std::optional<ExpectedPoints> expected_points_of_las(std::string_view start) {
  if (!start.starts_with("LASF") || start.size() < kNewHeader) return {};
  const Lattice lattice = lattice_of(start.data());
  const auto at = [&](std::size_t k) { return double_at(start.data() + kExtent + 8 * k); };
  // Many programs write a corner into the header without rounding it to one of the file's points.
  const auto corner = [&](const Point& p) { return lattice.at(lattice.nearest(p)); };
  const std::array<Point, 2> corners = {corner({at(0), at(2)}), corner({at(1), at(3)})};
  return ExpectedPoints{promised_points(start.data()), bounding_box(corners)};
}

void read_las(BlockReader& reader, PointFile& file) {
  LasReader(reader, file).read();
}

}  // namespace polylidar::tool::point_files
