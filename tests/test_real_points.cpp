// Real points: what the readers print is understood, a package that is not there says so, and the sets are
// data sets. Fake systems stand for the packages, which need not be installed; those that are, are read too.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "datasets/datasets.hpp"
#include "datasets/real/real_points.hpp"
#include "tests/complaint.hpp"
#include "tests/program.hpp"
#include "tests/temporary_folder.hpp"

namespace hullbench::testing {
namespace {

void write(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

std::string complaint_about(const std::string& text) {
  return complaint_of<std::exception>([&] { real::parse_sample(text); });
}

/// A system in a folder in which dpkg knows some packages, and whose cloud package has an archive.
class FakeSystem : public ::testing::Test {
 protected:
  FakeSystem() {
    write(root() / "var/lib/dpkg/status",
          "Package: r-cran-spdata\nStatus: deinstall ok config-files\nVersion: 1.0\n\n"
          "Package: libcgal-demo-extra\nStatus: install ok installed\nVersion: 7.0\n\n"
          "Package: libcgal-demo\nStatus: install ok installed\nArchitecture: all\nVersion: 6.0-1\n\n");
    write(root() / "var/lib/dpkg/info/libcgal-demo.list", "/.\n/usr/share/doc/cgal/data.tar.gz\n");
  }

  const fs::path& root() const { return folder_.path(); }

  /// Puts one file into the archive and reads it.
  real::Sample read(const std::string& name, const std::string& content, const std::string& object) {
    write(root() / "cloud" / name, content);
    fs::create_directories(root() / "usr/share/doc/cgal");
    succeeded(run_program({"tar", "-czf", (root() / "usr/share/doc/cgal/data.tar.gz").string(), "-C",
                           (root() / "cloud").string(), name},
                          {}));
    return real::read_sample({"real-x", "X", "libcgal-demo", object, "MIT"}, root());
  }

  TemporaryFolder folder_;
};

TEST(RealPoints, AreReadFromWhatTheReaderPrints) {
  const real::Sample sample = real::parse_sample(
      "Loading something\np 1 2\np -3.5 1e-3\nr\nw 0 0\nw 4 0\nw 4 4\nw 0 4\n"
      "r\nw 1 1\nw 1 2\nw 2 2\nw 2 1\nr\nw 9 9\nw 10 9\nw 10 10\n");
  EXPECT_EQ(sample.points, (std::vector<Point>{{1, 2}, {-3.5, 1e-3}}));
  ASSERT_EQ(sample.window.size(), 2U);
  EXPECT_EQ(sample.window[0].holes.size(), 1U);
  EXPECT_EQ(polylidar::area(sample.window), 16 - 1 + 0.5);
  EXPECT_TRUE(real::parse_sample("").points.empty());
}

TEST(RealPoints, NonsenseOfTheReaderIsRefused) {
  expect_says(complaint_about("p 1 two\n"), "'p 1 two' is no point");
  expect_says(complaint_about("p 1\n"), "no point");
  expect_says(complaint_about("p nan 1\n"), "no point");
  expect_says(complaint_about("w 1 1\n"), "before its first ring");
  expect_says(complaint_about("r\nw 0 0\nw 0 1\nw 1 1\n"), "lies in no shell");
}

TEST_F(FakeSystem, APackageIsInstalledOrNot) {
  EXPECT_EQ(real::installed_version("libcgal-demo", root()), "6.0-1");
  EXPECT_EQ(real::installed_version("r-cran-spdata", root()), std::nullopt);
  EXPECT_EQ(real::installed_version("r-cran-sp", root()), std::nullopt);
  EXPECT_EQ(real::installed_version("libcgal-demo", root() / "nowhere"), std::nullopt);
  const real::Source source = {"real-x", "X", "r-cran-sp", "x", "MIT"};
  EXPECT_EQ(real::describe(source, root()), "Debian's package r-cran-sp, not installed (make deps-real): x");
}

TEST_F(FakeSystem, AMissingPackageSaysWhatInstallsIt) {
  const DataFolders folders(default_data_directory(), {}, root());
  EXPECT_THROW(make_point_set("real-house", false, 0, 1, folders), real::NotInstalled);
  const std::string words =
      complaint_of<std::exception>([&] { make_point_set("real-house", false, 0, 1, folders); });
  expect_says(words, "r-cran-spdata");
  expect_says(words, "'make deps-real'");
}

TEST_F(FakeSystem, CloudsAreReadFromAbove) {
  EXPECT_EQ(read("a.xyz", "# x y z\n1 2 3 0 0 1\n\n4.5 -5 6\n", "a.xyz").points,
            (std::vector<Point>{{1, 2}, {4.5, -5}}));
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float z\nproperty double x\n"
      "property double y\nproperty int label\nelement face 1\nproperty list uchar int i\n"
      "end_header\n";
  const std::string ply = head + "9 1 2 0\n9 3 4 7\n9 5 6 7\n3 0 1 2\n";
  EXPECT_EQ(read("b.ply", ply, "b.ply").points, (std::vector<Point>{{1, 2}, {3, 4}, {5, 6}}));
  EXPECT_EQ(read("b.ply", ply, "b.ply label=7").points, (std::vector<Point>{{3, 4}, {5, 6}}));
  std::string binary =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty uchar red\nproperty short y\n"
      "property uchar x\nend_header\n";
  binary += std::string("\x05\xfe\xff\x07", 4) + "faces";
  EXPECT_EQ(read("c.ply", binary, "c.ply").points, (std::vector<Point>{{7, -2}}));
}

TEST_F(FakeSystem, AReaderThatFailsSaysWhy) {
  const std::string words = complaint_of<std::exception>([&] { read("a.xyz", "1 2 3\n", "b.xyz"); });
  expect_says(words, "real-x");
  expect_says(words, "b.xyz");
  const std::string none = complaint_of<std::exception>([&] { read("a.xyz", "# nothing\n", "a.xyz"); });
  expect_says(none, "no points of a.xyz");
}

TEST(RealPoints, SetsAreDataSetsWithoutATruth) {
  std::set<std::string> names;
  const std::vector<DatasetInfo> infos = datasets();
  for (const real::Source& source : real::sources()) {
    EXPECT_TRUE(names.insert(source.name).second) << source.name;
    EXPECT_TRUE(is_real(source.name)) << source.name;
    ASSERT_NE(find_dataset(infos, source.name), nullptr) << source.name;
    EXPECT_TRUE(find_dataset(infos, source.name)->own_points) << source.name;
    EXPECT_FALSE(source.title.empty() || source.licence.empty() || source.object.empty()) << source.name;
    EXPECT_TRUE(make_ground_truth(source.name, false).empty()) << source.name;
    EXPECT_EQ(base_shape(source.name), source.name);
  }
  EXPECT_FALSE(is_real("recorded-1"));
  EXPECT_FALSE(is_real("ca"));
}

TEST(RealPoints, ThePageAndThePlanHaveEverySet) {
  std::ifstream page_file(HULLBENCH_REAL_PAGE);
  const std::string page(std::istreambuf_iterator<char>(page_file), {});
  const std::string begin = "<!-- real: begin -->\n";
  const std::size_t start = page.find(begin);
  ASSERT_NE(start, std::string::npos);
  const std::size_t end = page.find("<!-- real: end -->", start);
  EXPECT_EQ(page.substr(start + begin.size(), end - start - begin.size()), real::markdown());

  std::ifstream plan_file(HULLBENCH_REAL_PLAN);
  const auto plan = json::parse(plan_file);
  std::vector<std::string> names;
  for (const real::Source& source : real::sources()) names.push_back(source.name);
  EXPECT_EQ(plan.at("cases").at(0).at("dataset").get<std::vector<std::string>>(), names);
  EXPECT_EQ(plan.at("field"), (json{"auto", "default"}));
  EXPECT_FALSE(plan.contains("methods"));
}

TEST(RealPoints, AreThoseOfTheInstalledPackages) {
  std::set<std::string> packages;
  for (const real::Source& source : real::sources()) {
    if (!real::installed_version(source.package, "/")) continue;
    SCOPED_TRACE(source.name);
    const bool is_first_of_package = packages.insert(source.package).second;
    const PointSet set = make_point_set(source.name, false, 0, 1);
    EXPECT_GE(set.points.size(), 30U);
    if (is_first_of_package) {
      EXPECT_EQ(set.sha256, make_point_set(source.name, false, 0, 2).sha256) << "no seed draws anything";
    }
    EXPECT_TRUE(set.ground_truth.empty());
    EXPECT_EQ(set.window.empty(), source.package != "r-cran-spatstat.data");
    std::set<double> heights;
    for (const Point& point : set.points) {
      EXPECT_TRUE(std::isfinite(point.x) && std::isfinite(point.y));
      heights.insert(point.y);
    }
    EXPECT_GT(heights.size(), 10U);
  }
  if (packages.empty()) GTEST_SKIP() << "skipped: none of the packages is installed ('make deps-real')";
}

}  // namespace
}  // namespace hullbench::testing
