#include "benchmarks/league/league_report.hpp"

#include <algorithm>
#include <iomanip>
#include <map>
#include <set>
#include <sstream>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/files.hpp"
#include "benchmarks/base/number_format.hpp"
#include "benchmarks/base/words.hpp"
#include "benchmarks/record/protocols.hpp"
#include "benchmarks/tune/split.hpp"

namespace hullbench::league {
namespace {

void add_score(json& entry, const std::string& name, const std::optional<MedianScore>& score) {
  entry[name + "_median"] = score ? finite_or_null(score->median) : json(nullptr);
  entry[name + "_interval"] =
      score && score->interval
          ? json::array({finite_or_null(score->interval->low), finite_or_null(score->interval->high)})
          : json(nullptr);
  entry[name + "_cases"] = score ? score->cases : 0;
}

void add_mean(json& entry, const std::string& name, const std::optional<MeanScore>& score) {
  entry[name + "_mean"] = score ? json(score->mean) : json(nullptr);
  entry[name + "_mean_interval"] =
      score && score->interval ? json::array({score->interval->low, score->interval->high}) : json(nullptr);
}

/// The titles of the methods in the reports.
std::map<std::string, std::string> titles_of(const std::vector<json>& reports) {
  std::map<std::string, std::string> titles;
  for (const json& report : reports) {
    for (const json& method : report.at("methods"))
      titles.emplace(method.at("name").get<std::string>(), method.at("title").get<std::string>());
  }
  return titles;
}

json part_scores_to_json(const std::map<std::string, PartScore>& parts) {
  json result = json::object();
  for (const auto& [name, part] : parts) {
    result[name] = {
        {"cases", part.cases}, {"failures", part.failures}, {"l2_median", finite_or_null(part.l2_median)}};
  }
  return result;
}

json parts_to_json(const std::vector<LeaguePart>& parts) {
  json result = json::array();
  for (const LeaguePart& part : parts)
    result.push_back({{"name", part.name}, {"cases", part.cases}, {"seen", part.seen}});
  return result;
}

json entry_to_json(const LeagueEntry& entry, const std::map<std::string, std::string>& titles) {
  const auto title = titles.find(entry.method);
  json result = {{"method", entry.method},
                 {"title", title == titles.end() ? entry.method : title->second},
                 {"protocol", entry.protocol},
                 {"cases", entry.cases},
                 {"failures", entry.failures},
                 {"failures_by_status", entry.failures_by_status},
                 {"unscored_cases", entry.unscored_cases},
                 {"unscored_failures", entry.unscored_failures}};
  add_score(result, "l2", entry.l2);
  add_score(result, "l2_where_able", entry.l2_where_able);
  result["kinds"] = part_scores_to_json(entry.kinds);
  result["samplers"] = part_scores_to_json(entry.samplers);
  add_score(result, "hole_f1", entry.hole_f1);
  add_mean(result, "hole_f1", entry.hole_f1_mean);
  add_score(result, "skill", entry.skill);
  add_score(result, "regret", entry.regret);
  return result;
}

json profile_to_json(const LeagueProfile& profile) {
  json curves = json::array();
  for (const LeagueProfile::Curve& curve : profile.curves)
    curves.push_back({{"method", curve.method}, {"protocol", curve.protocol}, {"shares", curve.shares}});
  json left_out = json::array();
  for (const auto& [method, protocol] : profile.left_out)
    left_out.push_back({{"method", method}, {"protocol", protocol}});
  return {{"group", profile.group},
          {"cases", profile.cases},
          {"curves", std::move(curves)},
          {"left_out", std::move(left_out)}};
}

/// A value with its interval in units of `scale`; null is `worst`.
table::Cell interval_cell(const json& value, const json& interval, double scale = 1,
                          double worst = kInfinity) {
  const auto number = [&](const json& one) {
    return table::Number(one.is_null() ? worst : one.get<double>() * scale, 2);
  };
  table::Cell cell = number(value);
  if (!interval.is_null() && !value.is_null()) cell.range = {number(interval[0]), number(interval[1])};
  return cell;
}

table::Cell median_cell(const json& entry, const std::string& name, double scale, double worst = kInfinity) {
  if (entry.at(name + "_cases") == 0) return {};
  return interval_cell(entry.at(name + "_median"), entry.at(name + "_interval"), scale, worst);
}

table::Cell mean_cell(const json& entry, const std::string& name) {
  if (entry.at(name + "_mean").is_null()) return {};
  return interval_cell(entry.at(name + "_mean"), entry.at(name + "_mean_interval"));
}

table::Cell failures_cell(const json& entry) {
  table::Cell cell = entry.at("failures").get<std::size_t>();
  const json& unscored = entry.at("unscored_failures");
  if (unscored > 0) cell.sign = "+ " + unscored.dump();
  return cell;
}

std::string title_of_protocol(const std::string& name) {
  for (const record::Protocol& protocol : record::protocols()) {
    if (protocol.name == name) return protocol.title;
  }
  return name;
}

table::Table league_table(const json& league, const std::string& protocol) {
  table::Table table{"league_" + protocol,
                     "Protocol " + protocol + ": " + title_of_protocol(protocol),
                     {table::words("Method"), "Cases", "Failures", table::with_unit("L2 median", "%"),
                      table::with_unit("Where it can", "%"), "Skill median", "Hole F1 mean",
                      table::with_unit("Regret median", "%")}};
  for (const json& entry : league.at("methods")) {
    if (entry.at("protocol") != protocol) continue;
    const bool everywhere = entry.at("l2_where_able_cases") == entry.at("l2_cases");
    table.add_row({entry.at("title").get<std::string>(), entry.at("cases").get<std::size_t>(),
                   failures_cell(entry), median_cell(entry, "l2", 100),
                   everywhere ? table::Cell("=") : median_cell(entry, "l2_where_able", 100),
                   median_cell(entry, "skill", 1, -kInfinity), mean_cell(entry, "hole_f1"),
                   median_cell(entry, "regret", 100)});
  }
  return table;
}

table::Cell part_cell(const json& parts, const std::string& name) {
  const auto part = parts.find(name);
  if (part == parts.end()) return {};
  const json& median = part->at("l2_median");
  return table::Number(median.is_null() ? kInfinity : 100 * median.get<double>(), 1);
}

/// The medians of L2 by kind of shape and by way to sample, a column each.
table::Table parts_table(const json& league, const std::string& protocol) {
  table::Table table{"league_" + protocol + "_parts",
                     "Protocol " + protocol + ": median L2 in % by kind of shape and by way to sample",
                     {table::words("Method")}};
  bool all_seen = true;
  for (const char* of : {"kinds", "samplers"}) {
    for (const json& part : league.at(of)) {
      const bool seen = part.at("seen").get<bool>();
      all_seen = all_seen && seen;
      table.columns.emplace_back(
          part.at("name").get<std::string>() + (seen ? "" : " " + std::string(table::kSign)), "%");
    }
  }
  for (const json& entry : league.at("methods")) {
    if (entry.at("protocol") != protocol) continue;
    std::vector<table::Cell> cells = {entry.at("title").get<std::string>()};
    for (const char* of : {"kinds", "samplers"}) {
      for (const json& part : league.at(of))
        cells.push_back(part_cell(entry.at(of), part.at("name").get<std::string>()));
    }
    table.add_row(std::move(cells));
  }
  table.remarks.emplace_back(
      "Points that are not uniform are of few shapes in every column: others would move its median. "
      "league.json has the number of cases.");
  if (!all_seen)
    table.remarks.push_back(
        std::string(table::kSign) +
        ": a way to sample that was not seen in training. For outline Polylidar's "
        "default has a rule of its own, whose numbers were chosen with such points in view.");
  return table;
}

std::string title_of(const json& league, const json& curve) {
  for (const json& entry : league.at("methods")) {
    if (entry.at("method") == curve.at("method"))
      return entry.at("title").get<std::string>() + " (" + curve.at("protocol").get<std::string>() + ")";
  }
  return curve.at("method").get<std::string>();
}

std::string methods_of_group(const std::string& name) {
  for (const record::ProtocolGroup& group : record::protocol_groups()) {
    if (group.name == name) return group.methods;
  }
  return name;
}

/// Some of the taus, as columns.
table::Table profile_table(const json& league, const json& profile) {
  const std::vector<double> taus = league.at("taus").get<std::vector<double>>();
  std::vector<std::size_t> shown;
  for (std::size_t k = 0; k < taus.size(); ++k) {
    for (const double tau : {1.0, 1.1, 1.5, 2.0, 5.0, 10.0}) {
      if (taus[k] == tau) shown.push_back(k);
    }
  }
  const std::string group = profile.at("group").get<std::string>();
  table::Table table{"profile_" + group,
                     "Performance profile of the methods " + methods_of_group(group) +
                         ": % of the weight of " + profile.at("cases").dump() + " cases with an L2 that is",
                     {table::words("Method")}};
  for (const std::size_t k : shown)
    table.columns.emplace_back(k == 0 ? "best" : "within " + three_digits(taus[k]) + " x", "%");
  std::vector<json> curves = profile.at("curves").get<std::vector<json>>();
  std::ranges::stable_sort(curves, [&](const json& a, const json& b) {
    return a.at("shares")[shown[1]].get<double>() > b.at("shares")[shown[1]].get<double>();
  });
  for (const json& curve : curves) {
    std::vector<table::Cell> cells = {title_of(league, curve)};
    for (const std::size_t k : shown)
      cells.emplace_back(table::Number(100 * curve.at("shares")[k].get<double>(), 1));
    table.add_row(std::move(cells));
  }
  std::vector<std::string> left_out;
  for (const json& one : profile.at("left_out")) left_out.push_back(title_of(league, one));
  if (!left_out.empty())
    table.remarks.push_back("Left out, as they have less than half of the cases: " + join_words(left_out) +
                            ".");
  return table;
}

}  // namespace

json league_to_json(const League& league, const std::vector<json>& reports) {
  const auto titles = titles_of(reports);
  json result = {{"kind", "league"},
                 {"schema_version", 1},
                 {"created", reports.front().at("created")},
                 {"tool", reports.front().at("tool")},
                 {"environment", reports.front().at("environment")},
                 {"split", tune::split_to_json()},
                 {"shapes", league.shapes},
                 {"cases", league.cases},
                 {"kinds", parts_to_json(league.kinds)},
                 {"samplers", parts_to_json(league.samplers)},
                 {"taus", league_taus()},
                 {"plans", json::array()},
                 {"methods", json::array()},
                 {"profiles", json::array()},
                 {"not_installed", league.not_installed}};
  result["split"]["cases_of"] = league.test_only ? "test" : "all";
  for (const json& report : reports) result["plans"].push_back(report.at("plan").at("name"));
  for (const LeagueEntry& entry : league.entries) result["methods"].push_back(entry_to_json(entry, titles));
  for (const LeagueProfile& profile : league.profiles) result["profiles"].push_back(profile_to_json(profile));
  return result;
}

table::Document league_document(const json& league) {
  table::Document document;
  const bool test = league.at("split").at("cases_of") == "test";
  document.title = "League: " + std::to_string(league.at("cases").get<std::size_t>()) + " cases of " +
                   std::to_string(league.at("shapes").get<std::size_t>()) + " shapes" +
                   (test ? " on the test side of the split" : "");
  std::set<std::string> there;
  for (const json& entry : league.at("methods")) {
    if (entry.at("cases") > 0) there.insert(entry.at("protocol").get<std::string>());
  }
  for (const std::string& protocol : record::protocols_by_group()) {
    if (!there.contains(protocol)) continue;
    document.tables.push_back(league_table(league, protocol));
    document.tables.push_back(parts_table(league, protocol));
  }
  for (const json& profile : league.at("profiles")) {
    if (profile.at("cases") > 0) document.tables.push_back(profile_table(league, profile));
  }
  document.notes = {
      "L2 as a part of the ground truth's area; regret: L2 less what the same method has with the best value "
      "for the instance. In brackets a 95 % bootstrap interval of the median that resamples whole shapes. A "
      "failure is infinitely bad and has no holes.",
      "Every stratum, a way to sample and a kind of shape (simple; one part with holes; several parts), "
      "counts the same; in it every shape, and of a shape every case. \"Where it can\" is of the cases whose "
      "ground truth the method can have: of one part for a method that gives single polygons, without holes "
      "for one that has none; \"=\": of all.",
      "Skill: 0 is the convex hull, 1 are the Delaunay triangles whose centroid lies in the ground truth. "
      "Hole F1 is of the cases whose ground truth has holes, of which most find all or none: hence a mean, "
      "with a 95 % interval by shape. A second number of failures is of degenerate input."};
  if (!league.at("not_installed").empty())
    document.notes.push_back("Not installed, and so in no table: " +
                             join_words(league.at("not_installed").get<std::vector<std::string>>()) + ".");
  return document;
}

std::string league_csv(const League& league) {
  std::ostringstream out;
  out << "method,task,fold,error,time,points,status,shape,kind,sampler,weight\n"
      << std::setprecision(std::numeric_limits<double>::max_digits10);
  for (const LeagueResult& one : league.results) {
    out << one.method << '/' << one.protocol << ',' << table::csv_text(one.task) << ',' << one.seed << ','
        << one.l2 << ',';
    if (one.seconds) out << *one.seconds;
    out << ',' << one.points << ',' << one.status << ',' << table::csv_text(one.shape) << ',' << one.kind
        << ',' << one.sampler << ',' << one.weight << '\n';
  }
  return out.str();
}

json load_league(const fs::path& folder) {
  const fs::path file = folder / kLeagueFile;
  const std::optional<std::string> text = read_text_file(file);
  if (!text) return {};
  json league = json::parse(*text, nullptr, false);
  if (league.is_discarded()) throw ConfigurationError(file.string() + " is not JSON; get it anew");
  return league;
}

void write_league_tables(const fs::path& folder) {
  const json league = load_league(folder);
  if (league.is_null()) return;
  std::ostringstream out;
  table::print_markdown(league_document(league), out);
  write_text_file(folder / kLeagueTablesFile, out.str());
}

std::string league_results(const json& league, const std::string& folder) {
  constexpr std::size_t kFirst = 3;
  table::Table table{"league",
                     league_document(league).title + ", the first three of every protocol",
                     {table::words("Protocol"), table::words("Method"), "Cases", "Failures",
                      table::with_unit("L2 median", "%"), "Hole F1 mean"}};
  std::map<std::string, std::size_t> shown;
  std::vector<std::string> protocols;
  for (const json& entry : league.at("methods")) {
    const std::string protocol = entry.at("protocol").get<std::string>();
    if (entry.at("cases") == 0 || ++shown[protocol] > kFirst) continue;
    if (shown[protocol] == 1) protocols.push_back(protocol + ", " + title_of_protocol(protocol));
    table.add_row({protocol, entry.at("title").get<std::string>(), entry.at("cases").get<std::size_t>(),
                   failures_cell(entry), median_cell(entry, "l2", 100), mean_cell(entry, "hole_f1")});
  }
  std::ostringstream out;
  out << "\n### " << table.caption << "\n\n";
  table::print_markdown(table, out);
  out << '\n';
  const std::string file = folder + "/" + kLeagueTablesFile;
  table::print_item("All of the league's tables: [" + file + "](" + file + ").", out);
  table::print_item("Parameters: " + joined(protocols, "; ") + ".", out);
  table::print_item(
      "L2: the area where result and ground truth differ, in % of the latter; a failure is infinitely bad. "
      "Hole F1: 1 if all holes are found and no others, of cases with holes. In brackets 95 % intervals by "
      "shape.",
      out);
  return out.str();
}

}  // namespace hullbench::league
