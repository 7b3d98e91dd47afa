#include <algorithm>
#include <cmath>

#include "tool/points/numbers.hpp"
#include "tool/points/readers.hpp"

namespace polylidar::tool::point_files {
namespace {

struct Property {
  std::string name;
  Scalar type;                   ///< of the number, or of a list's elements
  std::optional<Scalar> length;  ///< of a list: the type of its length, which comes first
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;

  bool has_lists() const {
    return std::any_of(properties.begin(), properties.end(),
                       [](const Property& p) { return p.length.has_value(); });
  }
};

struct Header {
  bool is_text = true;
  bool big_endian = false;
  std::vector<Element> elements;
};

/// By PLY's names and by those that tell the size.
std::optional<Scalar> scalar_of(std::string_view name, bool big_endian) {
  using Kind = Scalar::Kind;
  struct Named {
    std::string_view names[2];
    Scalar type;
  };
  static constexpr Named kTypes[] = {
      {{"char", "int8"}, {Kind::kSigned, 1}},    {{"uchar", "uint8"}, {Kind::kUnsigned, 1}},
      {{"short", "int16"}, {Kind::kSigned, 2}},  {{"ushort", "uint16"}, {Kind::kUnsigned, 2}},
      {{"int", "int32"}, {Kind::kSigned, 4}},    {{"uint", "uint32"}, {Kind::kUnsigned, 4}},
      {{"float", "float32"}, {Kind::kFloat, 4}}, {{"double", "float64"}, {Kind::kFloat, 8}}};
  for (const Named& entry : kTypes) {
    if (name != entry.names[0] && name != entry.names[1]) continue;
    Scalar type = entry.type;
    type.big_endian = big_endian;
    return type;
  }
  return {};
}

class HeaderReader {
 public:
  explicit HeaderReader(BlockReader& reader) : reader_(reader) {}

  Header read() {
    std::string_view line;
    if (!reader_.next_line(line) || trimmed(line) != "ply")
      reader_.fail("it does not begin with the line 'ply' as a PLY file does; name its format with --input");
    bool has_format = false;
    while (reader_.next_line(line)) {
      std::string_view rest = line;
      const std::string_view word = take_word(rest);
      if (word == "end_header") {
        if (!has_format)
          reader_.fail_here("the PLY header has no format; write 'format ascii 1.0' below 'ply'");
        return std::move(header_);
      }
      if (word == "format") {
        has_format = true;
        read_format(rest);
      } else if (word == "element") {
        add_element(rest);
      } else if (word == "property") {
        add_property(rest);
      } else if (!word.empty() && word != "comment" && word != "obj_info") {
        reader_.fail_here(
            in_quotes(word) +
            " is no line of a PLY header; write format, comment, element, property or end_header");
      }
    }
    reader_.fail_here("the PLY header does not end; close it with end_header");
  }

 private:
  void read_format(std::string_view rest) {
    const std::string_view name = take_word(rest);
    if (!header_.elements.empty() ||
        (name != "ascii" && name != "binary_little_endian" && name != "binary_big_endian")) {
      reader_.fail_here(
          "the format " + in_quotes(name) +
          " is not PLY's; write ascii, binary_little_endian or binary_big_endian before the elements");
    }
    header_.is_text = name == "ascii";
    header_.big_endian = name == "binary_big_endian";
  }

  void add_element(std::string_view rest) {
    Element element;
    element.name = take_word(rest);
    const auto count = parse_count(take_word(rest));
    if (!count)
      reader_.fail_here("the element " + in_quotes(element.name) +
                        " has no number; write it as 'element vertex 100'");
    element.count = *count;
    header_.elements.push_back(std::move(element));
  }

  void add_property(std::string_view rest) {
    Property property;
    std::string_view word = take_word(rest);
    if (word == "list") {
      property.length = type_of(take_word(rest));
      if (property.length->kind == Scalar::Kind::kFloat)
        reader_.fail_here(
            "a list's length is no whole number; write as 'property list uchar int vertex_indices'");
      word = take_word(rest);
    }
    property.type = type_of(word);
    property.name = take_word(rest);
    if (header_.elements.empty() || property.name.empty())
      reader_.fail_here(
          "a property has no name or no element; write it as 'property float x' below its element");
    header_.elements.back().properties.push_back(std::move(property));
  }

  Scalar type_of(std::string_view name) const {
    const auto type = scalar_of(name, header_.big_endian);
    if (!type)
      reader_.fail_here(in_quotes(name) +
                        " is no type of PLY; write char, uchar, short, ushort, int, uint, float or double");
    return *type;
  }

  BlockReader& reader_;
  Header header_;
};

/// Reads the elements up to and with the points.
class BodyReader {
 public:
  BodyReader(BlockReader& reader, const Header& header) : reader_(reader), header_(header) {}

  std::vector<Point> read() {
    const auto vertex = std::find_if(header_.elements.begin(), header_.elements.end(),
                                     [](const Element& e) { return e.name == "vertex"; });
    if (vertex == header_.elements.end())
      reader_.fail("its PLY header has no element 'vertex'; only vertices are points");
    x_ = place_of(*vertex, "x");
    y_ = place_of(*vertex, "y");
    for (auto element = header_.elements.begin(); element != vertex; ++element) read_element(*element, false);
    read_element(*vertex, true);
    return std::move(points_);
  }

 private:
  std::size_t place_of(const Element& vertex, const std::string& name) const {
    const auto found = std::find_if(vertex.properties.begin(), vertex.properties.end(),
                                    [&](const Property& p) { return p.name == name && !p.length; });
    if (found == vertex.properties.end())
      reader_.fail("its PLY vertices have no property '" + name + "'; give them x and y as numbers");
    return static_cast<std::size_t>(found - vertex.properties.begin());
  }

  void read_element(const Element& element, bool are_points) {
    if (element.properties.empty()) return;
    const bool is_fixed = !header_.is_text && !element.has_lists();
    std::vector<std::size_t> offsets;
    std::size_t size = 0;
    for (const Property& property : element.properties) {
      offsets.push_back(size);
      size += property.type.size;
    }
    record_.resize(is_fixed ? size : 0);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      if (header_.is_text) {
        read_line(element, i, are_points);
      } else if (is_fixed) {
        if (!reader_.read(record_.data(), size)) fail_short(element, i);
        if (are_points)
          add(load(record_.data() + offsets[x_], element.properties[x_].type),
              load(record_.data() + offsets[y_], element.properties[y_].type), i);
      } else {
        read_with_lists(element, i, are_points);
      }
    }
  }

  void read_line(const Element& element, std::uint64_t index, bool are_points) {
    std::string_view line;
    do {
      if (!reader_.next_line(line)) fail_short(element, index);
    } while (trimmed(line).empty());
    if (!are_points) return;
    Point point;
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      std::string_view word = take_word(line);
      if (element.properties[p].length) {
        auto left = parse_count(word);
        if (!left)
          reader_.fail_here(in_quotes(word) + " is not the length of a list; write how many numbers follow");
        for (; *left > 0 && !word.empty(); --*left) word = take_word(line);
      }
      if (word.empty())
        reader_.fail_here(
            "there are fewer numbers than the vertex has properties; give every vertex all of them");
      if (p == x_) point.x = parse_coordinate(word, reader_);
      if (p == y_) point.y = parse_coordinate(word, reader_);
    }
    points_.push_back(point);
  }

  void read_with_lists(const Element& element, std::uint64_t index, bool are_points) {
    Point point;
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      const Property& property = element.properties[p];
      char bytes[8];
      const Scalar& first = property.length ? *property.length : property.type;
      if (!reader_.read(bytes, first.size)) fail_short(element, index);
      const double value = load(bytes, first);
      if (property.length) {
        if (value < 0)
          reader_.fail("a list of " + in_quotes(element.name) + " " + std::to_string(index + 1) +
                       " has a negative length; write the file again");
        if (!reader_.skip(static_cast<std::uint64_t>(value) * property.type.size)) fail_short(element, index);
      } else if (p == x_) {
        point.x = value;
      } else if (p == y_) {
        point.y = value;
      }
    }
    if (are_points) add(point.x, point.y, index);
  }

  void add(double x, double y, std::uint64_t index) {
    if (!std::isfinite(x) || !std::isfinite(y)) {
      reader_.fail("vertex " + std::to_string(index + 1) +
                   " has a coordinate that is not finite; remove such points");
    }
    points_.push_back({x, y});
  }

  [[noreturn]] void fail_short(const Element& element, std::uint64_t index) const {
    reader_.fail("it ends before " + in_quotes(element.name) + " " + std::to_string(index + 1) + " of " +
                 std::to_string(element.count) +
                 " that its header promises; it was cut short, so copy or save it again");
  }

  BlockReader& reader_;
  const Header& header_;
  std::vector<Point> points_;
  std::vector<char> record_;
  std::size_t x_ = 0;  ///< places among the vertex's properties
  std::size_t y_ = 0;
};

}  // namespace

std::vector<Point> read_ply(BlockReader& reader) {
  const Header header = HeaderReader(reader).read();
  return BodyReader(reader, header).read();
}

}  // namespace polylidar::tool::point_files
