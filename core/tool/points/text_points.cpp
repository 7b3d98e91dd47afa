#include <algorithm>
#include <array>
#include <deque>
#include <nlohmann/json.hpp>
#include <utility>

#include "tool/points/numbers.hpp"
#include "tool/points/readers.hpp"
#include "tool/program/letter_case.hpp"

namespace polylidar::tool::point_files {
namespace {

constexpr char kBlank = ' ';

/// Splits rows into fields, which it keeps until the next row.
class Row {
 public:
  explicit Row(const BlockReader& reader) : reader_(reader) {}

  void separate_by(char delimiter) { delimiter_ = delimiter; }
  char delimiter() const { return delimiter_; }
  /// At most `limit` fields: no more are looked for.
  void split(std::string_view line, std::size_t limit);
  const std::vector<std::string_view>& fields() const { return fields_; }

 private:
  std::string_view take_field(std::string_view& rest);
  std::string_view with_single_quotes(std::string_view field);

  const BlockReader& reader_;
  char delimiter_ = kBlank;
  std::vector<std::string_view> fields_;
  std::deque<std::string> unquoted_;  ///< fields with quotes in them
};

void Row::split(std::string_view line, std::size_t limit) {
  fields_.clear();
  unquoted_.clear();
  // One more delimiter than the line has ends its last field, be it an empty one.
  for (bool more = true; more && fields_.size() < limit;) {
    if (delimiter_ == kBlank && trimmed(line).empty()) return;
    const std::size_t before = line.size();
    fields_.push_back(take_field(line));
    more = delimiter_ == kBlank ? !line.empty() : before > 0 && !line.empty();
    if (more && delimiter_ != kBlank) line.remove_prefix(1);
  }
}

/// A quote inside a quoted field is doubled (RFC 4180, 2.7).
std::string_view Row::with_single_quotes(std::string_view field) {
  if (field.find('"') == std::string_view::npos) return field;
  std::string& text = unquoted_.emplace_back();
  for (std::size_t i = 0; i < field.size(); ++i) {
    text += field[i];
    if (field[i] == '"') ++i;
  }
  return text;
}

/// The next field, taken off `rest` up to the delimiter behind it.
std::string_view Row::take_field(std::string_view& rest) {
  // Blanks round a field mean nothing, but a tab that delimits is no blank.
  const std::size_t first = rest.find_first_not_of(delimiter_ == '\t' ? " " : " \t");
  if (first != std::string_view::npos && rest[first] == '"') {
    std::size_t quote = first + 1;
    while (quote < rest.size() && (rest[quote] != '"' || rest.substr(quote + 1).starts_with('"'))) {
      quote += rest[quote] == '"' ? 2U : 1U;
    }
    if (quote >= rest.size()) reader_.fail_here("a quote is not closed; close it in the same line");
    const std::string_view field = rest.substr(first + 1, quote - first - 1);
    rest.remove_prefix(quote + 1);
    const std::string_view tail = delimiter_ == kBlank ? rest.substr(0, rest.find_first_of(" \t"))
                                                       : trimmed(rest.substr(0, rest.find(delimiter_)));
    if (!tail.empty())
      reader_.fail_here("text follows a closing quote; double a quote inside a quoted field");
    rest.remove_prefix(delimiter_ == kBlank ? 0 : std::min(rest.find(delimiter_), rest.size()));
    return with_single_quotes(trimmed(field));
  }
  if (delimiter_ == kBlank) return take_word(rest);
  const std::string_view field = rest.substr(0, rest.find(delimiter_));
  rest.remove_prefix(field.size());
  return trimmed(field);
}

char delimiter_of(std::string_view row) {
  std::string bare;  // without what is quoted
  bool is_quoted = false;
  for (const char c : row) {
    if (c == '"') is_quoted = !is_quoted;
    if (!is_quoted) bare += c;
  }
  // In this order: where semicolons separate, a comma may be a decimal one, and then the number is refused.
  for (const char delimiter : {';', '\t', ','}) {
    if (bare.find(delimiter) != std::string::npos) return delimiter;
  }
  return kBlank;
}

/// Names of columns of x and of y that go together, in any pair; empty ones are none.
struct KnownNames {
  using Names = std::array<std::string_view, 4>;
  Names x;
  Names y;
  bool are_degrees;
};
constexpr std::array<KnownNames, 3> kKnownNames = {
    {{{"x"}, {"y"}, false},
     {{"lon", "longitude", "lng", "long"}, {"lat", "latitude"}, true},
     {{"easting"}, {"northing"}, false}}};

/// Which fields of a row hold x and y.
struct Columns {
  std::size_t x = 0;
  std::size_t y = 1;
  std::optional<std::size_t> by;  ///< what points are grouped by
  bool with_header = false;
  bool is_named = false;       ///< one of them is told by its name
  bool is_geographic = false;  ///< their names say longitude and latitude
  bool is_guess = false;       ///< their names say nothing, and they are the only two

  std::size_t needed() const { return std::max({x, y, by.value_or(0)}) + 1; }
};

class ColumnChoice {
 public:
  ColumnChoice(const BlockReader& reader, const std::vector<std::string_view>& first_row)
      : reader_(reader), row_(first_row) {}

  Columns choose(std::string_view wanted, std::string_view by) const {
    Columns columns;
    // Years may be names of columns, too.
    const bool has_known_names = choose_by_known_names(columns);
    columns.with_header = has_known_names || std::none_of(row_.begin(), row_.end(), is_number);
    if (!by.empty()) {
      columns.by = place_of(by, columns);
      if (!columns.by) refuse_by(by);
    }
    if (!wanted.empty()) {
      choose_by(wanted, columns);
    } else if (has_known_names) {
      columns.is_named = true;
    } else if (columns.with_header) {
      choose_the_only_two(columns);
    }
    if (columns.with_header) columns.is_geographic = are_degrees(columns);
    return columns;
  }

 private:
  void choose_by(std::string_view wanted, Columns& columns) const {
    const std::size_t comma = wanted.find(',');
    if (comma == std::string_view::npos) refuse(wanted);
    const auto x = place_of(trimmed(wanted.substr(0, comma)), columns);
    const auto y = place_of(trimmed(wanted.substr(comma + 1)), columns);
    if (!x || !y || *x == *y) refuse(wanted);
    columns.x = *x;
    columns.y = *y;
  }

  [[noreturn]] void refuse(std::string_view wanted) const {
    reader_.fail("--columns " + in_quotes(wanted) +
                 " does not name two columns; give two names or two numbers from 1 on, as in x,y or 1,2");
  }

  [[noreturn]] void refuse_by(std::string_view by) const {
    reader_.fail("--by " + in_quotes(by) +
                 " names no column; give a name of the first row or a number from 1 on");
  }

  /// Whether x and y are called longitude and latitude, in one of the known ways.
  bool are_degrees(const Columns& columns) const {
    if (std::max(columns.x, columns.y) >= row_.size()) return false;
    const auto is_one_of = [&](std::size_t column, const KnownNames::Names& names) {
      return std::any_of(names.begin(), names.end(), [&](std::string_view name) {
        return !name.empty() && equal_in_any_case(row_[column], name);
      });
    };
    return std::any_of(kKnownNames.begin(), kKnownNames.end(), [&](const KnownNames& names) {
      return names.are_degrees && is_one_of(columns.x, names.x) && is_one_of(columns.y, names.y);
    });
  }

  std::size_t find(std::string_view name) const {
    const auto exact = std::find(row_.begin(), row_.end(), name);
    if (exact != row_.end()) return static_cast<std::size_t>(exact - row_.begin());
    return static_cast<std::size_t>(
        std::find_if(row_.begin(), row_.end(),
                     [&](std::string_view field) { return equal_in_any_case(field, name); }) -
        row_.begin());
  }

  bool choose_by_known_names(Columns& columns) const {
    const auto find_one_of = [&](const KnownNames::Names& names) {
      std::size_t found = row_.size();
      for (const std::string_view name : names) {
        if (found == row_.size() && !name.empty()) found = find(name);
      }
      return found;
    };
    for (const KnownNames& names : kKnownNames) {
      const std::size_t x = find_one_of(names.x);
      const std::size_t y = find_one_of(names.y);
      if (x == row_.size() || y == row_.size()) continue;
      columns.x = x;
      columns.y = y;
      return true;
    }
    return false;
  }

  void choose_the_only_two(Columns& columns) const {
    columns.is_guess = row_.size() == 2;
    if (row_.size() <= 2) return;
    reader_.fail_here("none of the columns " + column_names() +
                      " is known to be x or y; name two of them with --columns, as in x,y or 1,2");
  }

  std::string column_names() const {
    std::string names;
    for (const std::string_view field : row_) names += (names.empty() ? "" : ", ") + in_quotes(field);
    return names;
  }

  /// Of a column by its name or number; nothing for a number that cannot be one.
  std::optional<std::size_t> place_of(std::string_view name, Columns& columns) const {
    if (name.empty()) return {};
    if (const auto number = parse_count(name)) {
      if (*number == 0 || *number > kMostColumns) return {};
      return static_cast<std::size_t>(*number - 1);
    }
    columns.with_header = columns.is_named = true;
    const std::size_t place = find(name);
    if (place < row_.size()) return place;
    reader_.fail_here("there is no column " + in_quotes(name) + "; the columns of this line are " +
                      column_names());
  }

  static constexpr std::uint64_t kMostColumns = 1000000;

  const BlockReader& reader_;
  const std::vector<std::string_view>& row_;
};

bool is_utf8(const std::string& text) {
  try {
    return !nlohmann::json(text).dump().empty();
  } catch (const nlohmann::json::type_error&) {
    return false;
  }
}

/// What begins with # is a comment before the first row. Behind it, it may be a name or a number of a point.
/// A tab that delimits is no blank: a row of tabs has no coordinates.
bool is_passed_over(std::string_view line, bool is_before_rows, char delimiter) {
  const std::size_t first = line.find_first_not_of(delimiter == '\t' ? " " : " \t");
  return first == std::string_view::npos || (is_before_rows && line[first] == '#');
}

/// Whether the fields are 0, 1, 2 and so on, as some programs name columns that have no names.
bool count_from_zero(const std::vector<std::string_view>& fields) {
  for (std::size_t f = 0; f < fields.size(); ++f) {
    if (fields[f] != std::to_string(f)) return false;
  }
  return true;
}

/// How many `fields` there are, without empty ones at the end.
std::size_t used(const std::vector<std::string_view>& fields) {
  const auto last =
      std::find_if(fields.rbegin(), fields.rend(), [](std::string_view field) { return !field.empty(); });
  return static_cast<std::size_t>(fields.rend() - last);
}

/// Whether a row may have more fields than that. Delimiters in quotes count, too.
bool may_have_more(std::string_view line, std::size_t fields, char delimiter) {
  return delimiter == kBlank ||
         static_cast<std::size_t>(std::count(line.begin(), line.end(), delimiter)) >= fields;
}

/// The delimiter in the line sep=; that spreadsheets write before the first row.
std::optional<char> announced_delimiter(std::string_view line) {
  constexpr std::string_view kStart = "sep=";
  if (line.size() != kStart.size() + 1 || !line.starts_with(kStart)) return {};
  return line.back();
}

}  // namespace

void read_columns(BlockReader& reader, bool only_blanks, PointFile& file) {
  Row row(reader);
  Labels labels;
  Columns columns;
  const std::optional<Box>& window = reader.options().window;
  std::size_t needed = 0;  // fields; 0: the first row has not come yet
  std::optional<char> announced;
  bool is_count_seen = false;  // in the first line of a PTS file, of its points
  std::size_t names = 0;       // in the first row, if rows are compared with them; 0: they are not
  std::string note;            // on the first row, if another one follows
  const auto start = [&](std::string_view line) {
    if (!only_blanks) row.separate_by(announced.value_or(delimiter_of(line)));
    row.split(line, line.size() + 1);
    if (only_blanks && row.fields().size() == 1 && line.find_first_of(",;") != std::string_view::npos) {
      reader.fail_here(
          "columns of .xyz, .pts and .asc are separated by blanks, and those of this line are not; give "
          "--input csv");
    }
    columns = ColumnChoice(reader, row.fields()).choose(reader.options().columns, reader.options().by);
    needed = columns.needed();
    if (columns.is_geographic) file.crs = crs_of_epsg(4326);
    if (columns.is_guess) {
      file.note = "the columns " + in_quotes(row.fields()[0]) + " and " + in_quotes(row.fields()[1]) +
                  " are taken for x and y; --columns says which is which";
    }
    if (!columns.with_header && count_from_zero(row.fields())) {
      note = "the first row " + in_quotes(line) + " is taken for a point; remove it if it is a header";
    }
  };
  const auto fail_short = [&] {
    const std::size_t count = row.fields().size();
    const bool lacks_by = columns.by && *columns.by >= count;
    const std::size_t lacking = lacks_by ? *columns.by : columns.x >= count ? columns.x : columns.y;
    reader.fail_here("there is no column " + std::to_string(lacking + 1) + ", as the line has " +
                     std::to_string(count) +
                     (columns.with_header && file.points.empty()
                          ? "; the first row, which has no number, was taken for names"
                          : "") +
                     (lacks_by ? "; choose another column with --by"
                               : "; give every point its x and y, or choose other columns with --columns"));
  };
  for (std::string_view line; reader.next_line(line);) {
    if (is_passed_over(line, needed == 0, row.delimiter())) continue;
    if (needed == 0) {
      if (line.find('\0') != std::string_view::npos) {
        reader.fail_here("there is a zero byte, so this is no text; name the right format with --input");
      }
      if (line.find('\r') != std::string_view::npos) {
        reader.fail_here("lines end with a carriage return alone; convert the file, as with tr '\\r' '\\n'");
      }
      if (!announced && !only_blanks) announced = announced_delimiter(line);
      if (announced && announced_delimiter(line)) continue;
      if (only_blanks && !is_count_seen && parse_count(trimmed(line))) {
        is_count_seen = true;
        continue;
      }
      start(line);
      if (columns.with_header) {
        names = columns.is_named || columns.is_guess ? row.fields().size() : 0;
        continue;
      }
    } else if (!note.empty()) {
      file.note = std::exchange(note, {});
    } else if (names > 0 && may_have_more(line, names, row.delimiter())) {
      row.split(line, line.size() + 1);
      const std::size_t count = used(row.fields());
      if (count > names) {
        reader.fail_here(
            "the line has " + std::to_string(count) + " fields, and the first row names " +
            std::to_string(names) +
            " columns, so it is not known which is which; name every column, write decimals with a "
            "point, or choose columns by their number with --columns, as in 2,3");
      }
    }
    // Where blanks separate, only the first row is compared: in others, words may follow the coordinates.
    if (row.delimiter() == kBlank) names = 0;
    row.split(line, needed);
    if (row.fields().size() < needed) fail_short();
    const Point point = {parse_coordinate(row.fields()[columns.x], reader),
                         parse_coordinate(row.fields()[columns.y], reader)};
    if (window && !is_inside(point, *window)) continue;
    file.points.push_back(point);
    hand_on(file, reader.options());
    if (columns.by) file.groups.push_back(labels.index_of(row.fields()[*columns.by]));
  }
  hand_on(file, reader.options(), true);
  if (!columns.by) return;
  labels.finish(file);
  if (!std::all_of(file.labels.begin(), file.labels.end(), is_utf8)) {
    reader.fail(
        "a value of the column of --by is not UTF-8; convert the file, as with iconv -f latin1 -t utf-8");
  }
}

}  // namespace polylidar::tool::point_files
