#include "benchmarks/collection_tables.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "benchmarks/claims.hpp"
#include "benchmarks/labels.hpp"
#include "benchmarks/number_format.hpp"
#include "benchmarks/statistics.hpp"

namespace hullbench {
namespace {

using nlohmann::json;

/// What the paper published of shapes like these at this size, or null.
const json& published_collection(const std::vector<Shape>& shapes) {
  static const json none;
  for (const json& collection : paper().at("collections")) {
    const std::string prefix = collection.at("dataset_prefix").get<std::string>();
    const bool all = std::all_of(shapes.begin(), shapes.end(), [&](const Shape& shape) {
      return shape.front().dataset.starts_with(prefix) && shape.front().n == collection.at("n");
    });
    if (all) return collection;
  }
  return none;
}

/// A line's values, one a shape on which it succeeded.
struct Values {
  std::vector<double> errors;      ///< fractions, as the paper divides them
  std::vector<double> times;       ///< as the paper took them, ms
  std::vector<double> equal_work;  ///< ms
};

double median_milliseconds(const std::vector<const RunRecord*>& runs, Boundary boundary) {
  return median(all_times(runs, boundary)) / 1e6;
}

Values values_of(const TableContext& context, const Line& line, const std::vector<Shape>& shapes) {
  Values values;
  for (const Shape& shape : shapes) {
    const auto runs = context.measurements.find(line.method, line.protocol, shape.front());
    if (runs.empty() || first_failure(runs) != nullptr) continue;
    const std::vector<double> errors = all_values(runs, "l2_paper");
    if (!errors.empty()) values.errors.push_back(median(std::span<const double>(errors)));
    values.times.push_back(median_milliseconds(runs, Boundary::kPaper));
    values.equal_work.push_back(median_milliseconds(runs, Boundary::kEqualWork));
  }
  return values;
}

/// Mean, standard deviation and maximum, each as `text` writes a number.
template <typename Text>
void add_statistics(std::vector<std::string>& cells, const std::vector<double>& values, const Text& text) {
  if (values.empty()) {
    cells.insert(cells.end(), 3, kNothing);
    return;
  }
  const std::optional<double> deviation = standard_deviation(std::span<const double>(values));
  cells.push_back(text(mean(std::span<const double>(values))));
  cells.push_back(deviation ? text(*deviation) : kNothing);
  cells.push_back(text(*std::max_element(values.begin(), values.end())));
}

std::vector<std::string> published_line(const json& published, const std::string& method) {
  std::vector<std::string> cells = {paper().at("methods").value(method, method) + ", in the paper",
                                    published.at("shapes").dump()};
  const json& values = published.at("methods").at(method);
  for (const json& percent : values.at("l2_percent")) cells.push_back(fixed(percent.get<double>(), 1));
  for (const json& time : values.at("milliseconds")) cells.push_back(fixed(time.get<double>(), 1));
  cells.emplace_back(kNothing);
  return cells;
}

void print_summary(TableContext& context, const std::vector<Line>& lines, const std::vector<Shape>& shapes,
                   const json& published, std::ostream& out) {
  TextTable table(
      {"Method", "Shapes", "L2 mean, %", "std", "max", "Time mean, ms", "std", "max", "Equal work mean, ms"});
  for (const Line& line : lines) {
    const Values values = values_of(context, line, shapes);
    // Every shape that failed has its note, like in a table of its own.
    std::string marks;
    for (const Shape& shape : shapes) {
      const std::string mark = failure_marks(context, line, shape);
      if (marks.find(mark) == std::string::npos) marks += mark;
    }
    std::vector<std::string> cells = {label(context, line) + marks, std::to_string(values.times.size())};
    add_statistics(cells, values.errors, [](double value) { return fixed(100 * value, 1); });
    add_statistics(cells, values.times, [](double value) { return three_digits(value); });
    cells.push_back(values.equal_work.empty()
                        ? kNothing
                        : three_digits(mean(std::span<const double>(values.equal_work))));
    table.add_row(std::move(cells));
    const bool has_published = line.protocol == paper().at("protocol") && !published.is_null() &&
                               published.at("methods").contains(line.method);
    if (has_published) table.add_row(published_line(published, line.method));
  }
  out << "### " << shapes.size() << " shapes, n = " << shapes.front().front().n
      << ": error (of the result's area) and time as the paper took them\n\n";
  table.print(out);
  out << '\n';
}

void print_errors(const TableContext& context, const std::vector<Line>& lines,
                  const std::vector<Shape>& shapes, const json& published, std::ostream& out) {
  std::vector<std::string> header = {"Shape"};
  for (const Line& line : lines) header.push_back(label(context, line));
  TextTable table(std::move(header));
  bool has_brackets = false;
  for (const Shape& shape : shapes) {
    const Case& which = shape.front();
    std::vector<std::string> cells = {shape_title(context, which)};
    for (const Line& line : lines) {
      const auto runs = context.measurements.find(line.method, line.protocol, which);
      const RunRecord* failure = first_failure(runs);
      std::string text = kNothing;
      if (failure != nullptr) {
        text = failure->status == Status::kNotInstalled ? "" : failure_name(*failure);
      } else if (const auto errors = all_values(runs, "l2_paper"); !errors.empty()) {
        text = fixed(100 * median(std::span<const double>(errors)), 1);
        const json value =
            published.is_null() || line.protocol != paper().at("protocol")
                ? json()
                : published.at("by_shape").value(which.dataset, json::object()).value(line.method, json());
        if (value.is_number()) {
          text += " (" + fixed(value.get<double>(), 1) + ")";
          has_brackets = true;
        }
      }
      cells.push_back(std::move(text));
    }
    table.add_row(std::move(cells));
  }
  out << "### Error L2 of every shape, % of the result's area"
      << (has_brackets ? " (in brackets the paper's)" : "") << "\n\n";
  table.print(out);
  out << '\n';
}

}  // namespace

bool is_collection(const std::vector<Shape>& shapes) {
  constexpr std::size_t kMany = 10;
  const bool one_size = std::all_of(shapes.begin(), shapes.end(), [&](const Shape& shape) {
    return shape.size() == 1 && shape.front().n == shapes.front().front().n;
  });
  if (shapes.empty() || !one_size) return false;
  return shapes.size() >= kMany || !published_collection(shapes).is_null();
}

void print_collection(TableContext& context, const std::vector<Shape>& shapes, std::ostream& out) {
  std::vector<Line> lines;
  for (const Shape& shape : shapes) {
    for (const Line& line : lines_of(context, shape)) {
      if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
    }
  }
  const json& published = published_collection(shapes);
  print_summary(context, lines, shapes, published, out);
  if (!published.is_null()) {
    print_item("The paper's values are from its " + published.at("where").get<std::string>() +
                   "; its letters are of another Garamond.",
               out);
    out << '\n';
  }
  print_errors(context, lines, shapes, published, out);
}

}  // namespace hullbench
