#include <cctype>
#include <optional>

#include "tool/points/numbers.hpp"
#include "tool/points/readers.hpp"
#include "tool/program/letter_case.hpp"

namespace polylidar::tool::point_files {
namespace {

/// Reads one geometry after the other.
class WktReader {
 public:
  explicit WktReader(BlockReader& reader) : reader_(reader) {}

  void read(PointFile& file) {
    for (skip_blanks(); reader_.peek() != BlockReader::kEnd; skip_blanks()) {
      geometry(0);
      // Some programs end every geometry like a statement.
      skip_blanks();
      if (reader_.peek() == ';') reader_.get();
    }
    file.points = std::move(points_);
    file.crs = crs_;
  }

 private:
  // Collections nest by recursion.
  static constexpr int kDeepestNesting = 64;
  // Longer than any number that a program writes.
  static constexpr std::size_t kLongestWord = 512;

  void skip_blanks() {
    for (;;) {
      const int c = reader_.peek();
      if (c == '#') {
        while (reader_.peek() != '\n' && reader_.peek() != BlockReader::kEnd) reader_.get();
      } else if (c == BlockReader::kEnd || std::isspace(c) == 0) {
        return;
      } else {
        reader_.get();
      }
    }
  }

  /// The next letters, digits, signs and points; empty when something else comes.
  const std::string& word() {
    skip_blanks();
    word_.clear();
    for (int c = reader_.peek(); std::isalnum(c) != 0 || c == '+' || c == '-' || c == '.' || c == '_';
         c = reader_.peek()) {
      word_ += static_cast<char>(reader_.get());
      if (word_.size() > kLongestWord) fail_word("a word is too long");
    }
    return word_;
  }

  std::string keyword() { return upper_case(word()); }

  [[noreturn]] void fail_word(const std::string& what) const {
    reader_.fail_here(what + " (" + in_quotes(word_) +
                      "); write geometries as POINT (1 2) or MULTIPOINT ((1 2), (3 4))");
  }

  bool accept(char c) {
    skip_blanks();
    if (reader_.peek() != c) return false;
    reader_.get();
    return true;
  }

  void expect(char c) {
    if (accept(c)) return;
    const int found = reader_.peek();
    reader_.fail_here(std::string("'") + c + "' is missing before " +
                      (found == BlockReader::kEnd ? "the end of the text"
                                                  : in_quotes(std::string(1, static_cast<char>(found)))) +
                      "; write geometries as POINT (1 2) or MULTIPOINT ((1 2), (3 4))");
  }

  void geometry(int depth) {
    if (depth > kDeepestNesting)
      reader_.fail_here("collections nest too deeply; give the points in one MULTIPOINT");
    std::string type = keyword();
    if (type == "SRID" && accept('=')) {
      if (const auto number = parse_count(word()); number && *number > 0 && *number < 1000000) {
        const auto epsg = static_cast<int>(*number);
        if (srid_ && *srid_ != epsg) {
          reader_.fail_here("the SRID is " + std::to_string(epsg) + ", and it was " + std::to_string(*srid_) +
                            " before; give points of one coordinate system");
        }
        srid_ = epsg;
        crs_ = crs_of_epsg(epsg);
      }
      expect(';');
      type = keyword();
    }
    const bool is_empty = !opens(type);
    if (type == "POINT") {
      if (is_empty) return;
      position();
      expect(')');
    } else if (type == "MULTIPOINT") {
      if (!is_empty) members([&] { multipoint_member(); });
    } else if (type == "GEOMETRYCOLLECTION") {
      if (!is_empty) members([&] { geometry(depth + 1); });
    } else {
      refuse(type);
    }
  }

  /// Passes over what follows the type, up to and with the bracket; false for EMPTY. Takes a dimension that
  /// is written together with the type off it.
  bool opens(std::string& type) {
    if (!is_known(type)) {
      for (const char* dimension : {"ZM", "Z", "M"}) {
        if (type.ends_with(dimension)) {
          type.resize(type.size() - std::string_view(dimension).size());
          break;
        }
      }
      if (!is_known(type)) refuse(type);
    }
    std::string next = keyword();
    if (next == "Z" || next == "M" || next == "ZM") next = keyword();
    if (next == "EMPTY") return false;
    if (!next.empty()) fail_word("a bracket or EMPTY is missing after " + type);
    expect('(');
    return true;
  }

  static bool is_known(const std::string& type) {
    return type == "POINT" || type == "MULTIPOINT" || type == "GEOMETRYCOLLECTION";
  }

  [[noreturn]] void refuse(const std::string& type) const {
    if (type.empty())
      reader_.fail_here("there is no geometry's name where one must be; write POINT or MULTIPOINT");
    reader_.fail_here(in_quotes(type) +
                      " is no set of points; give POINT, MULTIPOINT or GEOMETRYCOLLECTION of these");
  }

  template <class Read>
  void members(const Read& read) {
    do read();
    while (accept(','));
    expect(')');
  }

  void multipoint_member() {
    if (accept('(')) {
      position();
      expect(')');
      return;
    }
    skip_blanks();
    if (const int c = reader_.peek(); c == 'E' || c == 'e') {
      if (keyword() != "EMPTY") fail_word("a point is missing");
      return;
    }
    position();
  }

  void position() {
    const double x = parse_coordinate(word(), reader_);
    const double y = parse_coordinate(word(), reader_);
    for (int further = 0; !word().empty(); ++further) {
      if (further == 2) fail_word("a point has more than four coordinates");
      if (!is_number(word_)) fail_word("a coordinate is not a number");
    }
    points_.push_back({x, y});
  }

  BlockReader& reader_;
  std::vector<Point> points_;
  Crs crs_;
  std::optional<int> srid_;
  std::string word_;
};

}  // namespace

void read_wkt_points(BlockReader& reader, PointFile& file) {
  WktReader(reader).read(file);
}

}  // namespace polylidar::tool::point_files
