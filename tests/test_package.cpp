// The installed core: what is in it, and a project of a stranger's that is built against it in both ways.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/complaint.hpp"
#include "tests/program.hpp"
#include "tests/temporary_folder.hpp"

namespace hullbench::testing {
namespace {

namespace fs = std::filesystem;

const fs::path kExample = fs::path(SOURCE_FOLDER) / "tests/package";
const std::string kExampleOutput = "shell of 40 vertices, hole of 12 vertices\narea 86\n";

std::string succeed(const std::vector<std::string>& command, const ProgramOptions& options = {}) {
  const Outcome outcome = run_program(command, options);
  EXPECT_EQ(outcome.code, 0) << command[0] << ": " << outcome.out << outcome.err;
  return outcome.out;
}

const std::set<std::string> kToolFiles = {"bin/polylidar",
                                          "share/bash-completion/completions/polylidar",
                                          "share/doc/polylidar/LICENSE",
                                          "share/man/man1/polylidar-footprint.1",
                                          "share/man/man1/polylidar-hull.1",
                                          "share/man/man1/polylidar-merge.1",
                                          "share/man/man1/polylidar.1",
                                          "share/zsh/site-functions/_polylidar"};

class PackageTest : public ::testing::Test {
 protected:
  void install(const std::vector<std::string>& options) {
    succeed(joined({CMAKE_PROGRAM, "--install", BUILD_FOLDER, "--prefix", prefix()}, options));
  }

  /// The core's package, moved after it was installed.
  void install_and_move() {
    install({"--component", "polylidar"});
    const fs::path moved = folder_.path() / "moved";
    fs::rename(prefix_, moved);
    prefix_ = moved;
  }

  std::set<std::string> installed_files() const {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(prefix_)) {
      if (entry.is_regular_file()) names.insert(entry.path().lexically_relative(prefix_));
    }
    return names;
  }

  Outcome configure(const fs::path& project) const {
    return run_program({CMAKE_PROGRAM, "-S", project, "-B", build_of(project),
                        "-DCMAKE_PREFIX_PATH=" + prefix(), "-DCMAKE_FIND_USE_CMAKE_SYSTEM_PATH=OFF",
                        std::string("-DCMAKE_CXX_COMPILER=") + CXX_COMPILER});
  }

  ProgramOptions pkg_config_path() const {
    ProgramOptions options;
    options.environment["PKG_CONFIG_LIBDIR"] = prefix_ / libraries() / "pkgconfig";
    return options;
  }

  std::string pkg_config(const std::vector<std::string>& options) const {
    return succeed(joined({PKG_CONFIG_PROGRAM, "polylidar"}, options), pkg_config_path());
  }

  /// "lib", or what the system has in its stead.
  fs::path libraries() const {
    for (const auto& entry : fs::recursive_directory_iterator(prefix_)) {
      if (entry.path().filename() == "libpolylidar.a") {
        return entry.path().parent_path().lexically_relative(prefix_);
      }
    }
    ADD_FAILURE() << "no library is installed";
    return "lib";
  }

  std::string prefix() const { return prefix_; }
  std::string build_of(const fs::path& project) const {
    return folder_.path() / ("build-" + project.filename().string());
  }

  TemporaryFolder folder_;
  fs::path prefix_ = folder_.path() / "installed";
};

TEST_F(PackageTest, IsTheCoreAndNothingElse) {
  install({});  // all that an installation without a component takes
  const std::string lib = libraries();
  std::set<std::string> expected = {lib + "/libpolylidar.a",
                                    lib + "/cmake/polylidar/polylidar-config.cmake",
                                    lib + "/cmake/polylidar/polylidar-config-version.cmake",
                                    lib + "/cmake/polylidar/polylidar-targets.cmake",
                                    lib + "/cmake/polylidar/polylidar-targets-" BUILD_TYPE ".cmake",
                                    lib + "/pkgconfig/polylidar.pc",
                                    "share/doc/polylidar/LICENSE"};
  for (const auto& header : fs::directory_iterator(fs::path(SOURCE_FOLDER) / "core/include/polylidar")) {
    expected.insert("include/polylidar/" + header.path().filename().string());
  }
  EXPECT_EQ(installed_files(), expected);
  EXPECT_FALSE(expected.contains("include/polylidar/check.hpp")) << "that is for tests";
}

TEST_F(PackageTest, TheToolIsAComponentOfItsOwnAndLinksNoOtherLibrary) {
  if (HAS_GDAL) GTEST_SKIP() << "skipped: this build links GDAL, as it was asked to";
  install({"--component", "tool"});
  EXPECT_EQ(installed_files(), kToolFiles);
  const std::string program = (prefix_ / "bin/polylidar").string();
  EXPECT_EQ(succeed({program, "--version"}), "polylidar " PROJECT_VERSION ", without GDAL\n");
  // What the licence of the program depends on: the C and C++ libraries, and zlib.
  std::istringstream lines(succeed({"ldd", program}));
  for (std::string line; std::getline(lines, line);) {
    const std::string name = line.substr(line.find_first_not_of(" \t"));
    bool is_known = false;
    for (const char* known : {"linux-", "/lib", "lib64", "libc.so", "libm.so", "libgcc_s.so", "libstdc++.so",
                              "libz.so", "libpthread.so", "libdl.so", "ld-linux"}) {
      is_known |= name.starts_with(known);
    }
    EXPECT_TRUE(is_known) << line;
  }
}

// A build of the tool alone has the install rules of this folder, and none of packaging/.
TEST_F(PackageTest, TheToolHasItsManualWithoutTheHarness) {
  succeed({CMAKE_PROGRAM, "-DCMAKE_INSTALL_PREFIX=" + prefix(), "-DCMAKE_INSTALL_COMPONENT=tool", "-P",
           std::string(BUILD_FOLDER) + "/core/tool/cmake_install.cmake"});
  EXPECT_EQ(installed_files(), kToolFiles);
}

TEST_F(PackageTest, NamesNothingOfTheBuild) {
  install({"--component", "polylidar"});
  for (const std::string& name : installed_files()) {
    if (name.ends_with(".a")) continue;
    const std::string text = read_text(prefix_ / name);
    for (const std::string& unwanted : {std::string(SOURCE_FOLDER), prefix(), std::string("hullbench::")}) {
      EXPECT_EQ(text.find(unwanted), std::string::npos) << name << " names " << unwanted;
    }
  }
}

TEST_F(PackageTest, IsFoundByCMakeWhereverItIsMoved) {
  install_and_move();
  succeeded(configure(kExample));
  succeed({CMAKE_PROGRAM, "--build", build_of(kExample)});
  EXPECT_EQ(succeed({build_of(kExample) + "/lattice"}), kExampleOutput);
}

TEST_F(PackageTest, IsFoundByPkgConfigWhereverItIsMoved) {
  install_and_move();
  const std::string program = folder_.path() / "lattice";
  succeed({"/bin/sh", "-c", R"("$0" -std=c++20 "$1" -o "$2" $("$3" --cflags --libs --static polylidar))",
           CXX_COMPILER, kExample / "main.cpp", program, PKG_CONFIG_PROGRAM},
          pkg_config_path());
  EXPECT_EQ(succeed({program}), kExampleOutput);
  expect_says(pkg_config({"--libs", "--static"}), "-pthread");
}

TEST_F(PackageTest, HasTheVersionOfTheHarnessInBothWays) {
  install_and_move();
  EXPECT_EQ(pkg_config({"--modversion"}), PROJECT_VERSION "\n");
  expect_says(read_text(prefix_ / libraries() / "cmake/polylidar/polylidar-config-version.cmake"),
              "set(PACKAGE_VERSION \"" PROJECT_VERSION "\")");
}

TEST_F(PackageTest, OfAnotherMinorVersionIsRefused) {
  install_and_move();
  const std::string project = read_text(kExample / "CMakeLists.txt");
  const std::string wanted = "polylidar 0.2 ";
  ASSERT_NE(project.find(wanted), std::string::npos);
  for (const std::string other : {"0.1", "0.3"}) {
    const fs::path folder = folder_.path() / other;
    fs::create_directory(folder);
    std::string text = project;
    text.replace(text.find(wanted), wanted.size(), "polylidar " + other + " ");
    write_text(folder / "CMakeLists.txt", text);
    write_text(folder / "main.cpp", "");
    const Outcome configured = configure(folder);
    EXPECT_NE(configured.code, 0) << other;
    expect_says(configured.err, "version: " PROJECT_VERSION);
  }
}

}  // namespace
}  // namespace hullbench::testing
