#include "benchmarks/choose/choice_page.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "benchmarks/base/number_format.hpp"
#include "benchmarks/base/words.hpp"
#include "benchmarks/record/pictures.hpp"
#include "tool/shapes/polygon_writers.hpp"

namespace hullbench::choose {
namespace {

using polylidar::tool::SvgCanvas;

constexpr std::size_t kMostDots = record::PictureBook::kMostPoints;

constexpr const char* kNoTruth =
    "Nobody knows the true shape of these points, so nothing here says which method is right: choose by the "
    "pictures. Agreement and stability are hints only; the convex hull is very stable and seldom the shape.";

constexpr const char* kProtocols =
    "Nothing was chosen by hand: \"default\" is the method's own choice of its parameters, \"auto\" one rule "
    "from the points for every method that keeps small triangles or erodes large ones.";

constexpr const char* kStyle = R"css(
:root{color-scheme:light dark;--ground:#fff;--text:#1b1f24;--quiet:#57606a;--line:#d0d7de;--code:#f3f5f7;
--hull:#4c8bbf;--edge:#1f4e79;--dot:#333;--bad:#a40e26}
@media (prefers-color-scheme:dark){:root{--ground:#14181d;--text:#e6e9ed;--quiet:#a4adb8;--line:#39424d;--code:#20262d;
--hull:#4c8bbf;--edge:#9ccbf5;--dot:#d5dae0;--bad:#ff8a94}}
*{box-sizing:border-box}
body{margin:0 auto;max-width:100rem;padding:1rem;font:1rem/1.45 system-ui,sans-serif;background:var(--ground);
color:var(--text);overflow-wrap:break-word}
h1{font-size:1.5rem;margin:0 0 .5rem}
h2{font-size:1.2rem;margin:2rem 0 .5rem}
.card h2{font-size:1rem;margin:0}
p{margin:.5rem 0;max-width:50rem}
a{color:inherit}
.lead{font-weight:600}
.cards{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,20rem),1fr));gap:1rem;margin-top:1rem}
.card{border:1px solid var(--line);border-radius:.5rem;padding:.75rem;min-width:0}
.card:target{grid-column:1/-1}
.card .smaller{display:none}
.card:target .smaller{display:inline}
.card svg{display:block;width:100%;height:20rem;margin:.5rem 0}
.card:target svg{height:85vh}
.hull{fill:var(--hull);fill-opacity:.4;fill-rule:evenodd;stroke:var(--edge);stroke-width:1.5;stroke-linejoin:round;
vector-effect:non-scaling-stroke}
.invalid .hull{fill:none;stroke:var(--bad)}
.dots{fill:none;stroke:var(--dot);stroke-width:4;stroke-linecap:round;stroke-opacity:.5}
dl{display:grid;grid-template-columns:repeat(auto-fill,minmax(8.5rem,1fr));gap:.25rem .75rem;margin:.5rem 0}
dt{color:var(--quiet);font-size:.8rem}
dd{margin:0;font-variant-numeric:tabular-nums}
.quiet{color:var(--quiet);font-size:.85rem}
.bad{color:var(--bad)}
pre{margin:.25rem 0 .5rem;padding:.5rem;background:var(--code);border-radius:.25rem;font:.8rem/1.4 ui-monospace,monospace;
white-space:pre-wrap;overflow-wrap:anywhere}
.wide{overflow-x:auto}
table{border-collapse:collapse;font-size:.8rem;font-variant-numeric:tabular-nums}
th,td{padding:.2rem .4rem;text-align:right;white-space:nowrap}
tbody th{text-align:left;font-weight:400}
td{background:color-mix(in srgb,var(--hull) calc(var(--iou)*.5%),transparent)}
)css";

/// A number of a card, and a column of the table.
struct Measure {
  std::string title;
  std::string unit;
  std::function<std::optional<table::Number>(const Candidate&)> value;
};

std::optional<double> metric(const Candidate& candidate, const char* name) {
  const auto found = candidate.record.metrics.find(name);
  return found != candidate.record.metrics.end() && found->is_number() ? std::optional(found->get<double>())
                                                                       : std::nullopt;
}

std::optional<table::Number> percent(const std::optional<double>& share) {
  if (!share) return std::nullopt;
  return table::Number(100 * *share, *share < 1 ? 1 : 0);
}

std::vector<Measure> measures(const PointSource& source) {
  const auto count = [](const char* name) {
    return [name](const Candidate& candidate) {
      const auto value = metric(candidate, name);
      return value ? std::optional(table::Number(*value, 0)) : std::nullopt;
    };
  };
  const auto share = [](const char* name) {
    return [name](const Candidate& candidate) { return percent(metric(candidate, name)); };
  };
  const auto time = [](const Candidate& candidate) -> std::optional<table::Number> {
    if (candidate.record.time_ns.empty()) return std::nullopt;
    return table::Number(static_cast<double>(candidate.record.time_ns.front()) / 1e6);
  };
  const auto area = [](const Candidate& candidate) {
    const auto value = metric(candidate, "area");
    return value ? std::optional(table::Number(*value)) : std::nullopt;
  };
  std::vector<Measure> shown = {
      {"Time", "ms", time},
      {"Points", "",
       [](const Candidate& candidate) { return table::Number(static_cast<double>(candidate.points), 0); }},
      {"Parts", "", count("polygons")},
      {"Holes", "", count("holes")},
      {"Vertices", "", count("vertices")},
      {"Area", source.in_metres ? "m²" : "", area},
      {"Covered", "%", share("points_covered")},
      {"Agreement", "%", [](const Candidate& candidate) { return percent(candidate.agreement); }}};
  if (source.draws > 0) shown.push_back({"Stability", "%", share("agreement_halves")});
  return shown;
}

std::vector<std::string> definitions(const PointSource& source) {
  std::vector<std::string> told = {
      "Time: one run on one core, from points to polygons in memory.",
      "Covered: points in the hull or on its edge.",
      "Agreement: mean IoU (area in both over area in either) with the other results that "
      "differ; the same polygons count once.",
      "Commands: hullbench is in the folder build of the project; a shell finds it there or where it is "
      "installed."};
  if (source.in_metres) told.emplace_back("Area: on the sphere, as of polylidar hull.");
  if (source.draws > 0) {
    told.push_back("Stability: IoU of the hulls of two random halves of the " +
                   std::string(source.taken < source.total ? "sample" : "points") + ", the mean of " +
                   std::to_string(source.draws) + (source.draws == 1 ? " draw." : " draws."));
  }
  return told;
}

/// "invalid output"
std::string failure_of(const Candidate& candidate) {
  std::string words = to_string(candidate.record.status);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else if (c == '>') {
      result += "&gt;";
    } else if (c == '"') {
      result += "&quot;";
    } else {
      result += c;
    }
  }
  return result;
}

/// `<tag>text</tag>`; `tag` may have attributes.
std::string element(const std::string& tag, const std::string& text) {
  return "<" + tag + ">" + escaped(text) + "</" + tag.substr(0, tag.find(' ')) + ">\n";
}

class Page {
 public:
  Page(const Candidates& candidates, std::span<const Point> points, const PointSource& source)
      : candidates_(candidates),
        points_(points),
        source_(source),
        measures_(measures(source)),
        canvas_(source.box),
        frame_("viewBox=\"0 0 " + fixed(canvas_.width(), 2) + " " + fixed(canvas_.height(), 2) + "\"") {}

  std::string text() const {
    std::string page =
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
        "'unsafe-inline'\">\n" +
        element("title", "Hulls of " + source_.name) + "<style>" + kStyle + "</style>\n</head>\n<body>\n" +
        dots() + "<main id=\"all\">\n" + element("h1", "Hulls of " + source_.name) +
        element("p class=\"lead\"", kNoTruth);
    page += element(
        "p", told_of(source_) + " " + kProtocols + " Sorted by agreement. A picture grows when it is chosen" +
                 (points_.size() > kMostDots ? "; it shows " + std::to_string(kMostDots) + " points." : "."));
    page += "<div class=\"cards\">\n";
    for (std::size_t i = 0; i < candidates_.all.size(); ++i) page += card(i);
    page += "</div>\n" + matrix() + absent() + element("h2", "How to read it") + "<ul>\n";
    for (const std::string& definition : definitions(source_)) page += element("li", definition);
    return page + "</ul>\n</main>\n</body>\n</html>\n";
  }

 private:
  static std::string number(std::size_t index) { return std::to_string(index + 1); }
  std::string numbered(std::size_t index) const {
    return number(index) + ". " + candidates_.all[index].label;
  }

  /// Drawn once, and shown again in every picture.
  std::string dots() const {
    const std::size_t shown = std::min(points_.size(), kMostDots);
    std::string path;
    for (std::size_t k = 0; k < shown; ++k) {
      const Point& point = points_[k * points_.size() / shown];
      path += "M" + fixed(canvas_.x(point), 1) + " " + fixed(canvas_.y(point), 1) + "h0";
    }
    return "<svg width=\"0\" height=\"0\" style=\"position:absolute\" aria-hidden=\"true\"><defs><path "
           "id=\"dots\" class=\"dots\" d=\"" +
           path + "\"/></defs></svg>\n";
  }

  std::string picture(std::size_t index) const {
    const Candidate& candidate = candidates_.all[index];
    if (!candidate.result) return "";
    std::string hull;
    for (const Polygon& polygon : *candidate.result) {
      if (!is_near(polygon))
        return element("p class=\"quiet\"", "The result is too far away from the points to be drawn.");
      hull += svg_path(polygon, canvas_);
    }
    return "<a href=\"#m" + number(index) + R"("><svg role="img" )" +
           (candidate.succeeded() ? "" : "class=\"invalid\" ") + frame_ + " aria-label=\"The hull by " +
           escaped(candidate.label) + R"("><path class="hull" d=")" + hull +
           "\"/><use href=\"#dots\"/></svg></a>\n";
  }

  /// Whether the polygon is where pixels can tell.
  bool is_near(const Polygon& polygon) const {
    constexpr double kFarthest = 1e6;
    const auto is_ring_near = [&](const Ring& ring) {
      return std::ranges::all_of(ring, [&](const Point& vertex) {
        return std::abs(canvas_.x(vertex)) < kFarthest && std::abs(canvas_.y(vertex)) < kFarthest;
      });
    };
    return is_ring_near(polygon.shell) && std::ranges::all_of(polygon.holes, is_ring_near);
  }

  std::string card(std::size_t index) const {
    const Candidate& candidate = candidates_.all[index];
    std::string text = R"(<article class="card" id="m)" + number(index) + "\">\n" +
                       element("h2", numbered(index)) + picture(index) +
                       "<a class=\"smaller quiet\" href=\"#all\">smaller</a>\n";
    if (candidate.succeeded()) {
      text += "<dl>\n";
      for (const Measure& measure : measures_) {
        const auto value = measure.value(candidate);
        text += "<div>" + element("dt", measure.title) +
                element("dd", value ? value->text() + (measure.unit.empty() ? "" : " " + measure.unit)
                                    : table::kNothing) +
                "</div>\n";
      }
      text += "</dl>\n";
    } else {
      text += element("p class=\"bad\"", sentence(failure_of(candidate) + ": " + candidate.record.detail) +
                                             " It got " + std::to_string(candidate.points) + " points.");
    }
    text += element("p class=\"quiet\"", remarks(index));
    for (const PasteCommand& command : candidate.commands)
      text += element("p class=\"quiet\"", command.purpose) + element("pre", command.line);
    return text + "</article>\n";
  }

  /// Who has the same polygons, and what the method was given.
  std::string remarks(std::size_t index) const {
    const Candidate& candidate = candidates_.all[index];
    std::vector<std::string> same;
    for (std::size_t i = 0; i < candidates_.all.size(); ++i) {
      if (i != index && candidate.is_same_as(i)) same.push_back(number(i));
    }
    std::string text = same.empty() ? "" : "The same polygons as " + join_words(same) + ". ";
    if (!candidate.note.empty()) text += candidate.note + " ";
    for (const auto& [name, value] : candidate.given)
      text += name + " = " + polylidar::tool::shortest(value) + ". ";
    const std::string& version = candidate.record.method_version;
    return text + (version.empty() ? "" : "Version " + version);
  }

  std::string matrix() const {
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < candidates_.all.size(); ++i) {
      if (candidates_.all[i].succeeded()) rows.push_back(i);
    }
    if (rows.size() < 2) return "";
    std::string text = element("h2", "How far they agree: IoU of each two, %") +
                       "<div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"IoU of each two\">"
                       "<table>\n<thead><tr><td></td>";
    for (const std::size_t column : rows) text += element("th scope=\"col\"", number(column));
    text += "</tr></thead>\n<tbody>\n";
    for (const std::size_t row : rows) {
      text += "<tr>" + element("th scope=\"row\"", numbered(row));
      for (const std::size_t column : rows) {
        const auto iou = percent(candidates_.all[row].iou[column]);
        if (row == column || !iou) {
          text += element("td", table::kNothing);
        } else {
          text += element("td style=\"--iou:" + fixed(iou->value, 0) + "\"", iou->text());
        }
      }
      text += "</tr>\n";
    }
    return text + "</tbody>\n</table></div>\n";
  }

  std::string absent() const {
    if (candidates_.absent.empty()) return "";
    std::string text = element("h2", "Not asked") + "<ul>\n";
    for (const std::string& why : candidates_.absent) text += element("li", why);
    return text + "</ul>\n";
  }

  const Candidates& candidates_;
  std::span<const Point> points_;
  const PointSource& source_;
  std::vector<Measure> measures_;
  SvgCanvas canvas_;
  std::string frame_;
};

}  // namespace

std::string told_of(const PointSource& source) {
  std::string text = source.name + " has " + std::to_string(source.total) + " points";
  if (source.taken < source.total) {
    text += "; " + std::to_string(source.taken) + " of them, drawn with seed " + std::to_string(source.seed) +
            ", were taken" + (source.all_where_fast ? ", and all by the methods that are fast enough" : "");
  }
  return text + (source.in_metres ? "; their longitudes and latitudes were taken as metres." : ".");
}

std::string choice_page(const Candidates& candidates, std::span<const Point> points,
                        const PointSource& source) {
  return Page(candidates, points, source).text();
}

table::Document choice_table(const Candidates& candidates, const PointSource& source) {
  table::Table table{"choice", told_of(source), {table::words("Method")}};
  table.caption.pop_back();
  const std::vector<Measure> shown = measures(source);
  for (const Measure& measure : shown) {
    table.columns.push_back(measure.unit.empty() ? table::Column(measure.title)
                                                 : table::with_unit(measure.title, measure.unit));
  }
  for (const Candidate& candidate : candidates.all) {
    std::vector<table::Cell> cells = {candidate.label};
    for (const Measure& measure : shown) {
      const auto value = candidate.succeeded() ? measure.value(candidate) : std::nullopt;
      cells.push_back(value ? table::Cell(*value) : table::Cell());
    }
    if (!candidate.succeeded()) cells[1] = failure_of(candidate);
    table.add_row(std::move(cells));
  }
  table.remarks = definitions(source);
  table.remarks.insert(table.remarks.begin(), kNoTruth);
  return {"Hulls of " + source.name, {std::move(table)}};
}

}  // namespace hullbench::choose
