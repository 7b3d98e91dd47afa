#include <algorithm>
#include <array>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

#include "tool/points/labels.hpp"
#include "tool/points/numbers.hpp"
#include "tool/points/readers.hpp"

namespace polylidar::tool::point_files {
namespace {

using nlohmann::json;

/// The reader's bytes as the parser wants them. The default one is the end.
class ByteIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = char;

  ByteIterator() = default;
  explicit ByteIterator(BlockReader& reader) : reader_(&reader) {}

  char operator*() const { return static_cast<char>(reader_->peek()); }
  ByteIterator& operator++() {
    reader_->get();
    return *this;
  }
  friend bool operator==(const ByteIterator& a, const ByteIterator& b) { return a.ended() == b.ended(); }

 private:
  bool ended() const { return reader_ == nullptr || reader_->peek() == BlockReader::kEnd; }

  BlockReader* reader_ = nullptr;
};

enum class Member { kOther, kType, kCoordinates, kGeometry, kGeometries, kFeatures, kProperties, kCrs };

Member member_of(const std::string& name) {
  if (name == "type") return Member::kType;
  if (name == "coordinates") return Member::kCoordinates;
  if (name == "geometry") return Member::kGeometry;
  if (name == "geometries") return Member::kGeometries;
  if (name == "features") return Member::kFeatures;
  if (name == "properties") return Member::kProperties;
  if (name == "crs") return Member::kCrs;
  return Member::kOther;
}

/// A GeoJSON object that is being read.
struct Object {
  std::string type;
  Member member = Member::kOther;  ///< the one that is being read
  bool in_list = false;            ///< inside the array of its features or geometries
  bool has_coordinates = false;
  bool has_content = false;        ///< a geometry, geometries or features
  std::size_t position_depth = 0;  ///< arrays round a number of its coordinates; 0: none seen
  std::size_t first_point = 0;     ///< how many there were before
  std::string label;               ///< of a feature: its property that points are grouped by
};

/// Takes the points out of a GeoJSON document as it is parsed. Members may come in any order, so the type
/// may follow the coordinates and is checked at the object's end; what does not matter here (foreign members,
/// properties but for the one that points are grouped by) is passed over whole.
class PointHandler : public nlohmann::json_sax<json> {
 public:
  explicit PointHandler(const BlockReader& reader) : reader_(reader), by_(reader.options().by) {}

  void take(PointFile& file) {
    if (!by_.empty()) {
      check_found();
      group_points("");
      file.groups = std::move(groups_);
      labels_.finish(file);
    }
    file.points = std::move(points_);
    file.crs = crs_;
  }

  bool null() override {
    if (skipped_ > 0) return take_label("");
    if (depth_ > 0) reader_.fail_here("a coordinate is null; give the number or remove the point");
    if (in_member(Member::kCrs)) crs_ = Crs();  // as GeoJSON had it before RFC 7946: not known
    if (in_member(Member::kGeometry)) {         // RFC 7946, 3.2: a feature that is nowhere
      objects_.back().has_content = true;
      return true;
    }
    return plain_value();
  }
  bool boolean(bool value) override {
    if (is_label_) return take_label(value ? "true" : "false");
    return plain_value();
  }
  bool number_integer(number_integer_t value) override {
    if (is_label_) return take_label(std::to_string(value));
    return number(static_cast<double>(value));
  }
  bool number_unsigned(number_unsigned_t value) override {
    if (is_label_) return take_label(std::to_string(value));
    return number(static_cast<double>(value));
  }
  bool number_float(number_float_t value, const string_t&) override {
    if (is_label_) return take_label(plain_decimal(value));
    return number(value);
  }
  bool binary(binary_t&) override { return plain_value(); }

  bool string(string_t& value) override {
    if (is_label_) return take_label(value);
    if (skipped_ > 0 && is_crs_name_) crs_ = crs_of_name(value).value_or(Crs{.is_given = true});
    if (skipped_ > 0 || depth_ > 0 || !in_member(Member::kType)) return plain_value();
    if (!is_usable(value)) {
      reader_.fail_here(
          "there is a geometry of type " + in_quotes(value) +
          ", which is no set of points; give Point, MultiPoint, or features or collections of them");
    }
    objects_.back().type = value;
    return true;
  }

  bool start_object(std::size_t) override {
    if (skipped_ > 0 || skips_this_member()) {
      if (skipped_ == 0 && in_member(Member::kCrs)) crs_ = Crs{.is_given = true};  // unless its name is known
      refuse_as_label();
      ++skipped_;
    } else if (objects_.empty() || objects_.back().in_list || in_member(Member::kGeometry)) {
      if (in_member(Member::kGeometry)) objects_.back().has_content = true;
      objects_.emplace_back().first_point = points_.size();
    } else {
      misplaced();
    }
    return true;
  }

  bool key(string_t& name) override {
    if (skipped_ == 0) objects_.back().member = member_of(name);
    is_crs_name_ = skipped_ > 0 && objects_.back().member == Member::kCrs && name == "name";
    // Only what is directly in the properties.
    const bool is_property = skipped_ == 1 && objects_.back().member == Member::kProperties && !by_.empty();
    is_label_ = is_property && name == by_;
    found_ |= is_label_;
    if (is_property && properties_.size() < kMostNames) properties_.insert(name);
    return true;
  }

  bool end_object() override {
    if (skipped_ > 0) {
      --skipped_;
      return true;
    }
    check_complete(objects_.back());
    if (!by_.empty() && objects_.back().type == "Feature") group_feature(objects_.back());
    objects_.pop_back();
    return true;
  }

  bool start_array(std::size_t) override {
    if (skipped_ > 0 || skips_this_member()) {
      refuse_as_label();
      ++skipped_;
    } else if (depth_ > 0) {
      if (arrays_[depth_].numbers > 0 || depth_ + 1 == arrays_.size()) misplaced();
      arrays_[depth_].has_arrays = true;
      arrays_[++depth_] = {};
    } else if (in_member(Member::kCoordinates) && !objects_.back().has_coordinates) {
      objects_.back().has_coordinates = true;
      arrays_[depth_ = 1] = {};
    } else if (in_member(Member::kFeatures) || in_member(Member::kGeometries)) {
      objects_.back().in_list = objects_.back().has_content = true;
    } else {
      misplaced();
    }
    return true;
  }

  bool end_array() override {
    if (skipped_ > 0) {
      --skipped_;
    } else if (depth_ > 0) {
      end_coordinates();
      --depth_;
    } else {
      objects_.back().in_list = false;
    }
    return true;
  }

  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception& error) override {
    // "[json.exception.parse_error.101] parse error at line 2, column 7: syntax error ..."
    const std::string_view what = error.what();
    std::string cause(what.substr(what.find(error.id == kSyntaxError ? ": " : "] ") + 2));
    std::replace_if(
        cause.begin(), cause.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    reader_.fail_here("this is not JSON (" + cause + "); mend it here or name the right format with --input");
  }

 private:
  /// An open array of coordinates.
  struct Array {
    std::size_t numbers = 0;
    bool has_arrays = false;
  };

  static constexpr int kSyntaxError = 101;
  // Of all types a multipolygon's coordinates nest deepest, and it is refused only when its type comes.
  static constexpr std::size_t kDeepestCoordinates = 4;

  static bool is_usable(const std::string& type) {
    return type == "Point" || type == "MultiPoint" || is_container(type);
  }
  static bool is_container(const std::string& type) {
    return type == "Feature" || type == "FeatureCollection" || type == "GeometryCollection";
  }

  bool in_member(Member member) const {
    return !objects_.empty() && !objects_.back().in_list && objects_.back().member == member;
  }
  bool skips_this_member() const {
    return depth_ == 0 &&
           (in_member(Member::kOther) || in_member(Member::kProperties) || in_member(Member::kCrs));
  }

  [[noreturn]] void misplaced() const {
    if (objects_.empty()) {
      reader_.fail_here(
          R"(this is no GeoJSON object; begin with {"type": "MultiPoint", "coordinates": [[x, y], ...]})");
    }
    reader_.fail_here(
        "a member does not have the form that GeoJSON gives it; write \"coordinates\": [x, y] for a Point, "
        "[[x, y], ...] for a MultiPoint, and objects in \"geometry\", \"geometries\" and \"features\"");
  }

  bool plain_value() const {
    if (skipped_ == 0 && !skips_this_member()) misplaced();
    return true;
  }

  bool number(double value) {
    if (skipped_ > 0 || depth_ == 0) return plain_value();
    Array& array = arrays_[depth_];
    if (array.has_arrays) misplaced();
    if (array.numbers < position_.size()) position_[array.numbers] = value;
    ++array.numbers;
    return true;
  }

  void end_coordinates() {
    const Array& array = arrays_[depth_];
    if (array.has_arrays || (array.numbers == 0 && depth_ == 1)) return;
    if (array.numbers < 2) reader_.fail_here("a position has no x and y; write it as [x, y]");
    Object& object = objects_.back();
    if (object.position_depth != 0 && object.position_depth != depth_) misplaced();
    object.position_depth = depth_;
    const Point point = {position_[0], position_[1]};
    const std::optional<Box>& window = reader_.options().window;
    if (!window || is_inside(point, *window)) points_.push_back(point);
  }

  bool take_label(const std::string& label) {
    if (std::exchange(is_label_, false)) objects_.back().label = label;
    return true;
  }

  void refuse_as_label() const {
    if (!is_label_) return;
    reader_.fail_here("the property " + in_quotes(by_) +
                      " is a list or an object; give --by one that is text, a number, true or false");
  }

  /// Puts all points that have no group yet into this one.
  void group_points(std::string_view label) {
    if (groups_.size() < points_.size()) groups_.resize(points_.size(), labels_.index_of(label));
  }

  void group_feature(const Object& feature) {
    // What is in no feature has no property.
    if (groups_.size() < feature.first_point) groups_.resize(feature.first_point, labels_.index_of(""));
    group_points(feature.label);
  }

  void check_found() const {
    if (found_ || points_.empty()) return;
    std::string names;
    for (const std::string& name : properties_) names += (names.empty() ? "" : ", ") + in_quotes(name);
    reader_.fail("--by " + in_quotes(by_) + " names no property of its features; " +
                 (names.empty() ? "they have none" : "they have " + names));
  }

  void check_complete(const Object& object) const {
    if (object.type.empty()) {
      reader_.fail_here(R"(the object that ends here has no "type"; give it one, such as "MultiPoint")");
    }
    if (is_container(object.type) ? !object.has_content || object.has_coordinates : !object.has_coordinates) {
      reader_.fail_here("the " + object.type +
                        " that ends here has not the members of its type; give points their \"coordinates\", "
                        "features their \"geometry\", and collections their \"geometries\" or \"features\"");
    }
    const std::size_t right_depth = object.type == "Point" ? 1 : 2;
    if (object.position_depth != 0 && object.position_depth != right_depth) misplaced();
  }

  static constexpr std::size_t kMostNames = 12;

  const BlockReader& reader_;
  const std::string& by_;
  std::vector<Point> points_;
  std::vector<std::uint32_t> groups_;  ///< of the points of features that have ended
  Labels labels_;
  std::set<std::string> properties_;  ///< names, for a message
  bool found_ = false;                ///< a feature has the property that points are grouped by
  bool is_label_ = false;             ///< its value comes next
  std::vector<Object> objects_;       ///< the innermost last
  Crs crs_ = crs_of_epsg(4326);
  bool is_crs_name_ = false;  ///< the member that is being read is that of the coordinate system
  std::size_t skipped_ = 0;   ///< open containers that are passed over
  std::size_t depth_ = 0;     ///< open arrays of coordinates
  std::array<Array, kDeepestCoordinates + 1> arrays_{};  ///< depth -> the array open there; 0 is unused
  std::array<double, 2> position_{};
};

}  // namespace

void read_geojson_points(BlockReader& reader, PointFile& file) {
  PointHandler handler(reader);
  json::sax_parse(ByteIterator(reader), ByteIterator(), &handler);
  handler.take(file);
}

}  // namespace polylidar::tool::point_files
