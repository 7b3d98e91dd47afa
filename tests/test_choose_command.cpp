// `hullbench choose FILE`: a card for every method, commands that give what the card shows, failures as
// cards.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "polylidar/concave_hull.hpp"
#include "tests/complaint.hpp"
#include "tests/hullbench_test.hpp"
#include "tests/point_file_texts.hpp"
#include "tool/shapes/polygon_writers.hpp"

namespace hullbench::testing {
namespace {

using polylidar::tool::SvgCanvas;

const std::vector<std::string> kMethods = {"--only", "polylidar",     "--only", "cgal_alpha_shape",
                                           "--only", "cgal_delaunay", "--only", "convex_hull"};
constexpr std::size_t kRows = 6;

std::string csv(const Points& points, const std::string& header = "x,y\n") {
  return header + rows(points, ",");
}

/// What the first group of `pattern` is, at each place of `text`.
std::vector<std::string> all_of(const std::string& text, const std::string& pattern) {
  std::vector<std::string> found;
  const std::regex expression(pattern);
  for (std::sregex_iterator match(text.begin(), text.end(), expression), end; match != end; ++match)
    found.push_back((*match)[1]);
  return found;
}

std::string unescaped(std::string text) {
  for (const auto& [from, to] :
       {std::pair{"&lt;", "<"}, std::pair{"&gt;", ">"}, std::pair{"&quot;", "\""}, std::pair{"&amp;", "&"}})
    text = std::regex_replace(text, std::regex(from), to);
  return text;
}

/// A card of a page.
struct Card {
  std::string text;
  std::string title;
  std::vector<std::string> commands;
  std::string path;  ///< of the hull; empty: there is no picture
};

std::vector<Card> cards_of(const std::string& page) {
  std::vector<Card> cards;
  for (std::size_t at = page.find("<article"); at != std::string::npos; at = page.find("<article", at + 1)) {
    Card& card = cards.emplace_back();
    card.text = page.substr(at, page.find("</article>", at) - at);
    card.title = unescaped(all_of(card.text, "<h2>[0-9]+\\. ([^<]*)</h2>").at(0));
    for (const std::string& command : all_of(card.text, "<pre>([^<]*)</pre>"))
      card.commands.push_back(unescaped(command));
    const std::size_t path = card.text.find(R"(class="hull" d=")");
    if (path == std::string::npos) continue;
    const std::size_t begin = path + std::string(R"(class="hull" d=")").size();
    card.path = card.text.substr(begin, card.text.find('"', begin) - begin);
  }
  return cards;
}

int points_on(const Card& card) {
  return std::stoi(all_of(card.text, "<dt>Points</dt>\\s*<dd>([0-9]+)</dd>").at(0));
}

MultiPolygon shape_in(const fs::path& geojson) {
  MultiPolygon shape;
  const json coordinates = json::parse(read_text(geojson))["geometry"]["coordinates"];
  for (const json& polygon : coordinates) {
    std::vector<Ring> rings;
    for (const json& positions : polygon) {
      rings.emplace_back();
      for (std::size_t i = 0; i + 1 < positions.size(); ++i)
        rings.back().push_back({positions[i][0].get<double>(), positions[i][1].get<double>()});
    }
    shape.push_back({rings.front(), {rings.begin() + 1, rings.end()}});
  }
  return shape;
}

std::string path_of(const MultiPolygon& shape, const Points& frame) {
  const SvgCanvas canvas(polylidar::bounding_box(frame));
  std::string path;
  for (const Polygon& polygon : shape) path += svg_path(polygon, canvas);
  return path;
}

class ChooseCommandTest : public HullbenchTest {
 protected:
  Outcome choose(const std::vector<std::string>& arguments, const std::vector<std::string>& more = {}) const {
    return hullbench(joined(joined({"choose"}, arguments), more));
  }
  std::string page(const std::string& name = "points.csv.choice.html") const {
    return read_text(folder() / name);
  }
  void write_points(const Points& points, const std::string& name = "points.csv") const {
    write_text(folder() / name, csv(points));
  }
  /// The shape that the line writes, in a shell that knows the programs.
  MultiPolygon shape_by(const std::string& line) const {
    const std::string path = "PATH='" + fs::path(HULLBENCH).parent_path().string() + "':$PATH; ";
    const Outcome outcome = run_program({"/bin/sh", "-c", path + "rm -f *.geojson; " + line}, in_folder());
    EXPECT_EQ(outcome.code, 0) << line << "\n" << outcome.err;
    for (const auto& entry : fs::directory_iterator(folder())) {
      if (entry.path().extension() == ".geojson") return shape_in(entry.path());
    }
    ADD_FAILURE() << line << " writes nothing";
    return {};
  }
  /// A method that behaves as misbehaving_worker does in this mode.
  void add_method(const std::string& mode, const json& changes = json::object()) const {
    const fs::path manifests = folder() / "config" / "hullbench" / "adapters";
    fs::create_directories(manifests);
    json manifest = {{"manifest_version", 1},
                     {"name", mode},
                     {"title", mode + " <method>"},
                     {"licence", "MIT"},
                     {"citation", "none"},
                     {"native_output", "a ring"},
                     {"parameters", json::array({{{"name", "size"},
                                                  {"unit", "length"},
                                                  {"description", "Does nothing."},
                                                  {"minimum", 0},
                                                  {"maximum", 10},
                                                  {"default", 1}}})},
                     {"capabilities", {{"holes", false}, {"several_polygons", false}}},
                     {"command", {MISBEHAVING_WORKER, mode}}};
    manifest.update(changes);
    write_text(manifests / (mode + ".json"), manifest.dump());
  }
};

TEST_F(ChooseCommandTest, ThePageHasACardForEveryMethodSortedByAgreement) {
  write_points(square_without_a_disc(600, 5));
  const Outcome outcome = succeeded(choose({"points.csv"}, kMethods));
  expect_says(outcome.err, "hullbench: wrote points.csv.choice.html\n");
  const std::vector<Card> cards = cards_of(page());
  ASSERT_EQ(cards.size(), kRows);
  double last = 100;
  for (const Card& card : cards) {
    expect_says(outcome.out, "| " + card.title);
    EXPECT_FALSE(card.path.empty()) << card.title;
    for (const char* measure :
         {"Time", "Points", "Parts", "Holes", "Vertices", "Area", "Covered", "Agreement", "Stability"}) {
      const auto values =
          all_of(card.text, std::string("<dt>") + measure + "</dt>\\s*<dd>([0-9.]+)( [m%][^<]*)?</dd>");
      ASSERT_EQ(values.size(), 1U) << card.title << ": " << measure;
      if (std::string(measure) == "Agreement") {
        EXPECT_LE(std::stod(values[0]), last) << card.title;
        last = std::stod(values[0]);
      }
    }
  }
  const auto convex =
      std::ranges::find_if(cards, [](const Card& card) { return card.title == "Convex hull (default)"; });
  ASSERT_NE(convex, cards.end());
  EXPECT_EQ(all_of(convex->text, "<dt>Covered</dt>\\s*<dd>([0-9.]+) %</dd>").at(0), "100");
  // One frame, and nothing that has to be fetched or run.
  EXPECT_EQ(all_of(page(), "<svg role=\"img\" (viewBox=\"[^\"]*\")").size(), kRows);
  for (const std::string& frame : all_of(page(), R"(<svg role="img" (viewBox="[^"]*"))"))
    EXPECT_EQ(frame, all_of(page(), "<svg role=\"img\" (viewBox=\"[^\"]*\")")[0]);
  EXPECT_FALSE(contains(page(), "<script"));
  EXPECT_FALSE(contains(page(), "://"));
}

TEST_F(ChooseCommandTest, TheSamePolygonsCountOnceAndAreSaid) {
  write_points(square_without_a_disc(600, 5));
  const auto agreement = [&](const std::vector<std::string>& methods, const std::string& title) {
    EXPECT_EQ(choose({"points.csv", "--draws", "0"}, methods).code, 0);
    for (const Card& card : cards_of(page())) {
      if (card.title != title) continue;
      return all_of(card.text, "<dt>Agreement</dt>\\s*<dd>([^<]*)</dd>").at(0);
    }
    return std::string("no card");
  };
  const std::vector<std::string> two = {"--only", "convex_hull", "--only", "cgal_alpha_shape/auto"};
  const std::string with_one = agreement(two, "Convex hull (default)");
  EXPECT_FALSE(contains(page(), "The same polygons as"));
  std::vector<std::string> three = two;
  three.insert(three.end(), {"--only", "polylidar/auto"});
  EXPECT_EQ(agreement(three, "Convex hull (default)"), with_one);
  EXPECT_EQ(all_of(page(), "The same polygons as ([0-9])").size(), 2U);
  expect_says(with_one, " %");
  EXPECT_EQ(agreement({"--only", "convex_hull"}, "Convex hull (default)"), "–")
      << "there is nobody to agree with";
}

TEST_F(ChooseCommandTest, TheCommandOnACardGivesItsPolygons) {
  const Points points = square_without_a_disc(600, 5);
  write_points(points, "my 'own' points.csv");
  ASSERT_EQ(choose({"my 'own' points.csv", "--columns", "1,2"}, kMethods).code, 0);
  int by_polylidar = 0;
  for (const Card& card : cards_of(page("my 'own' points.csv.choice.html"))) {
    ASSERT_EQ(card.commands.size(), 1U) << card.title;
    const std::string& line = card.commands[0];
    by_polylidar += line.starts_with("hullbench hull ") ? 1 : 0;
    EXPECT_EQ(path_of(shape_by(line), points), card.path) << line;
  }
  EXPECT_EQ(by_polylidar, 2);
}

TEST_F(ChooseCommandTest, ASampleIsTheSameAgainAndIsSaid) {
  const Points points = square_without_a_disc(600, 5);
  write_points(points);
  const std::vector<std::string> two = {"--only", "polylidar", "--only", "convex_hull", "--draws", "0"};
  const auto paths = [&](const std::string& seed) {
    const Outcome outcome = succeeded(choose({"points.csv", "--n", "300", "--seed", seed}, two));
    expect_says(outcome.err, "points.csv has 600 points; 300 of them, drawn with seed " + seed);
    expect_says(page(), "300 of them, drawn with seed " + seed);
    return all_of(page(), "<path [^>]*d=\"([^\"]*)\"");
  };
  const std::vector<std::string> first = paths("3");
  EXPECT_EQ(first.size(), 4U) << "the points and three hulls";
  EXPECT_NE(paths("4"), first);
  EXPECT_EQ(paths("3"), first);

  for (const Card& card : cards_of(page())) {
    ASSERT_EQ(card.commands.size(), 2U);
    const MultiPolygon of_sample = shape_by(card.commands[0]);
    const MultiPolygon of_all = shape_by(card.commands[1]);
    EXPECT_EQ(path_of(of_sample, points), card.path) << card.title;
    EXPECT_EQ(points_on(card), 300) << card.title;
    EXPECT_NE(of_all, of_sample) << card.title;
    if (card.title != "Polylidar (default)") continue;
    EXPECT_EQ(of_all, to_coordinates(polylidar::concave_hull(points), points));
  }
}

TEST_F(ChooseCommandTest, MethodsThatAreFastEnoughGetAllPoints) {
  const Points points = square_without_a_disc(30000, 5);
  write_points(points);
  // 2 s for the sample, so more than 3 for one and a half times the points.
  add_method("takes_long");
  const Outcome outcome = succeeded(choose({"points.csv", "--draws", "1", "--timeout", "3"},
                                           {"--only", "polylidar/auto", "--only", "takes_long"}));
  expect_says(outcome.err,
              "points.csv has 30000 points; 20000 of them, drawn with seed 1, were taken, and all by the "
              "methods that are fast enough.");
  const std::vector<Card> cards = cards_of(page());
  ASSERT_EQ(cards.size(), 2U);
  for (const Card& card : cards) {
    EXPECT_EQ(all_of(card.text, "<dt>Stability</dt>\\s*<dd>([0-9.]+) %</dd>").size(), 1U) << card.title;
    if (card.title == "takes_long <method> (default)") {
      EXPECT_EQ(points_on(card), 20000);
      EXPECT_EQ(card.commands.size(), 2U);
    } else {
      EXPECT_EQ(points_on(card), 30000);
      ASSERT_EQ(card.commands.size(), 1U);
      EXPECT_TRUE(card.commands[0].starts_with("hullbench hull ")) << card.commands[0];
      EXPECT_EQ(path_of(shape_by(card.commands[0]), points), card.path);
    }
  }
}

TEST_F(ChooseCommandTest, DegreesAreMetresAndDegreesAgain) {
  const Points points = square_without_a_disc(600, 5, {8, 47});
  write_text(folder() / "places.csv", csv(points, "lon,lat\n"));
  ASSERT_EQ(
      choose({"places.csv", "--only", "polylidar/default", "--only", "convex_hull", "--draws", "0"}).code, 0);
  const std::string text = page("places.csv.choice.html");
  expect_says(text, "their longitudes and latitudes were taken as metres");
  EXPECT_EQ(all_of(text, "<dt>Area</dt>\\s*<dd>[0-9]+ (m²)</dd>").size(), 2U);
  const MultiPolygon by_polylidar = shape_by("polylidar hull places.csv --out hull.geojson");
  ASSERT_EQ(choose({"places.csv", "--only", "polylidar/default", "--write", "own.geojson"}).code, 0);
  EXPECT_EQ(shape_in(folder() / "own.geojson"), by_polylidar);
  const auto area_in = [&](const char* file) { return read_json(file)["properties"]["area"].get<double>(); };
  EXPECT_EQ(area_in("own.geojson"), area_in("hull.geojson")) << "both are areas on the sphere";
  const std::string in_square_metres = std::to_string(std::llround(area_in("hull.geojson"))) + " m²";
  expect_says(text, "<dd>" + in_square_metres + "</dd>");
  EXPECT_EQ(read_json("own.geojson")["properties"]["method"], "polylidar");
  write_text(folder() / "stray.csv", csv(points, "lon,lat\n") + "-9999,-9999\n");
  expect_refusal(choose({"stray.csv"}), 2,
                 "the coordinate system is longitude and latitude, but x is from -9999");
}

TEST_F(ChooseCommandTest, WhatIsSaidOfTheFileIsSaid) {
  write_text(folder() / "points.csv", csv(square_without_a_disc(50, 5), "a,b\n"));
  const Outcome outcome = choose({"points.csv", "--only", "convex_hull", "--draws", "0"});
  EXPECT_EQ(outcome.code, 0);
  expect_says(outcome.err, "the columns 'a' and 'b' are taken for x and y");
}

TEST_F(ChooseCommandTest, FailuresAreCards) {
  write_points(square_without_a_disc(100, 5));
  for (const char* mode : {"hang", "crash", "says_error", "invalid_polygon", "garbage_result"})
    add_method(mode);
  add_method("absent", {{"needs", {"/nowhere/library"}}, {"install", "make it"}});
  add_method("asks", {{"parameters", json::array({{{"name", "size"},
                                                   {"unit", "length"},
                                                   {"description", "Does nothing."},
                                                   {"minimum", 0},
                                                   {"maximum", 10}}})}});
  std::vector<std::string> arguments = {"points.csv", "--timeout", "1"};
  for (const char* mode :
       {"hang", "crash", "says_error", "invalid_polygon", "garbage_result", "absent", "convex_hull"})
    arguments.insert(arguments.end(), {"--only", mode});
  const Outcome outcome = choose(arguments);
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  const std::vector<Card> cards = cards_of(page());
  ASSERT_EQ(cards.size(), 6U);
  EXPECT_EQ(cards[0].title, "Convex hull (default)");
  const std::vector<std::pair<std::string, std::string>> expected = {{"hang", "timeout: "},
                                                                     {"crash", "crash: "},
                                                                     {"says_error", "error: no luck."},
                                                                     {"invalid_polygon", "invalid output: "},
                                                                     {"garbage_result", "invalid output: "}};
  for (const auto& [mode, words] : expected) {
    const auto card = std::ranges::find_if(
        cards, [&, &mode = mode](const Card& one) { return one.title == mode + " <method> (default)"; });
    ASSERT_NE(card, cards.end()) << mode;
    expect_says(card->text, "<p class=\"bad\">" + words);
    expect_says(card->text, " It got 100 points.</p>");
    EXPECT_TRUE(card->commands.empty()) << mode;
    EXPECT_EQ(card->path.empty(), mode != "invalid_polygon") << mode;
    expect_says(outcome.out, "| " + mode + " <method> (default)");
  }
  expect_says(page(), "<h2>Not asked</h2>\n<ul>\n<li>absent &lt;method&gt;: ");

  const Outcome written = choose({"points.csv", "--only", "crash", "--write", "out.geojson"});
  EXPECT_EQ(written.code, 4);
  EXPECT_FALSE(fs::exists(folder() / "out.geojson"));
  EXPECT_EQ(choose({"points.csv", "--only", "absent"}).code, 6);
  expect_refusal(choose({"points.csv", "--only", "asks"}), 2, "there is no method 'asks' that chooses");
}

TEST_F(ChooseCommandTest, BadInputIsOneSentence) {
  write_points(square_without_a_disc(50, 5));
  expect_refusal(choose({"nowhere.csv"}), 2, "nowhere.csv");
  expect_refusal(choose({"-"}), 2, "standard input cannot be read again");
  write_text(folder() / "header.csv", "x,y\n");
  expect_refusal(choose({"header.csv"}), 2, "header.csv has 0 points; a hull needs at least 3");
  write_text(folder() / "two.csv", "1,2\n3,4\n");
  expect_refusal(choose({"two.csv"}), 2, "two.csv has 2 points; a hull needs at least 3");
  write_text(folder() / "nan.csv", "1,2\n3,nan\n5,6\n");
  expect_refusal(choose({"nan.csv"}), 2, "nan.csv, line 2: ");
  expect_refusal(choose({"points.csv", "--only", "magic"}), 2,
                 "--only: there is no method 'magic' that chooses its parameters without the user; known are "
                 "polylidar/default");
  expect_refusal(choose({"points.csv", "--only", "polylidar/paper"}), 2,
                 "there is no method 'polylidar/paper'");
  expect_refusal(
      choose({"points.csv", "--only", "polylidar", "--write", "out.geojson"}), 2,
      "--write takes the polygons of one method; add --only and one of polylidar/default and polylidar/auto");
  expect_refusal(choose({"points.csv", "--out", "a.html", "--write", "out.geojson"}), 2, "excludes");
  expect_refusal(choose({"points.csv", "--columns", "9,10"}), 2, "points.csv");
  expect_refusal(choose({"points.csv", "--n", "2"}), 2, "--n");
  for (const char* option : {"--out", "--write"}) {
    expect_refusal(choose({"points.csv", "--only", "polylidar/default", option, "points.csv"}), 2,
                   "points.csv would replace the points that are read");
  }
  expect_refusal(choose({"points.csv", "--only", "convex_hull", "--out", "nowhere/page.html"}), 1,
                 "cannot write nowhere/page.html");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder()), fs::directory_iterator()), 4)
      << "nothing is written";
}

TEST_F(ChooseCommandTest, AnInterruptionLeavesNothing) {
  write_points(square_without_a_disc(100, 5));
  add_method("hang");
  fs::create_directory(folder() / "temporary");
  ProgramOptions options = in_folder();
  options.environment["TMPDIR"] = (folder() / "temporary").string();
  Program program(
      command({"choose", "points.csv", "--only", "hang", "--only", "convex_hull", "--timeout", "60"}),
      options);
  ASSERT_TRUE(wait_until([&] { return !fs::is_empty(folder() / "temporary"); }));
  ASSERT_TRUE(wait_until([&] { return children_of(program.pid()).size() == 2; }));
  program.send_signal(SIGINT);
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  EXPECT_TRUE(outcome.err.ends_with("hullbench: interrupted\n")) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_TRUE(fs::is_empty(folder() / "temporary"));
  for (const auto& entry : fs::directory_iterator(folder()))
    EXPECT_FALSE(contains(entry.path().filename(), "choice")) << entry.path();
}

}  // namespace
}  // namespace hullbench::testing
