// Manifests: what they say, what is wrong with them, and where they are found.
#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/names.hpp"
#include "benchmarks/record/validate.hpp"
#include "benchmarks/run/manifest.hpp"
#include "benchmarks/run/method_catalog.hpp"
#include "tests/complaint.hpp"
#include "tests/program.hpp"
#include "tests/temporary_folder.hpp"

namespace hullbench::testing {
namespace {

json good_manifest() {
  return {
      {"manifest_version", 1},
      {"name", "my_hull"},
      {"title", "My hull"},
      {"licence", "MIT"},
      {"citation", "A paper"},
      {"native_output", "a ring"},
      {"parameters",
       {{{"name", "k"}, {"unit", "1"}, {"description", "Neighbours."}, {"minimum", 3}, {"maximum", nullptr}},
        {{"name", "reach"},
         {"unit", "length"},
         {"description", "How far."},
         {"minimum", 0},
         {"maximum", nullptr},
         {"default", nullptr}}}},
      {"capabilities", {{"holes", true}, {"several_polygons", false}}},
      {"command", {"python3", "./my_hull.py", "--fast"}},
      {"needs", {"../library", "/usr/lib/library"}},
      {"install", "make it"},
      {"jit", true},
      {"runs",
       {{{"protocol", "auto"}, {"parameters", {{"k", 5}, {"reach", {{"rule", "auto_edge_length"}}}}}}}}};
}

class ManifestTest : public ::testing::Test {
 protected:
  fs::path write(const json& manifest, const std::string& name = "my_hull.json") {
    write_text(folder_.path() / name, manifest.dump());
    return folder_.path() / name;
  }

  void expect_fault(const json& manifest, const std::string& words) {
    const fs::path file = write(manifest);
    const std::string said = complaint_of<ConfigurationError>([&] { run::load_manifest(file); });
    expect_says(said, words);
    expect_says(said, file.string());
  }

  TemporaryFolder folder_;
};

TEST_F(ManifestTest, SaysWhatTheMethodIsAndHowToStartIt) {
  const run::Manifest manifest = run::load_manifest(write(good_manifest()));
  const worker::Method& method = manifest.method;
  EXPECT_EQ(method.name, "my_hull");
  EXPECT_EQ(method.title, "My hull");
  EXPECT_EQ(method.install, "make it");
  EXPECT_TRUE(method.jit);
  const fs::path folder = folder_.path();
  EXPECT_EQ(method.command, (std::vector<std::string>{"python3", folder / "my_hull.py", "--fast"}));
  EXPECT_EQ(method.needs, (std::vector<std::string>{folder.parent_path() / "library", "/usr/lib/library"}));
  ASSERT_TRUE(method.info);
  EXPECT_TRUE(method.info->capabilities.holes);
  EXPECT_TRUE(method.info->version.empty());
  EXPECT_EQ(method.sources, manifest.sha256.substr(0, 8));
  ASSERT_EQ(method.info->parameters.size(), 2U);
  EXPECT_FALSE(method.info->parameters[0].default_value);
  EXPECT_EQ(method.info->parameters[1].default_value, std::numeric_limits<double>::infinity());
  ASSERT_EQ(manifest.runs.size(), 1U);
  EXPECT_EQ(manifest.runs[0].method, "my_hull");
  EXPECT_EQ(manifest.runs[0].protocol, "auto");
  EXPECT_EQ(std::get<double>(manifest.runs[0].parameters.at("k")), 5);
}

TEST_F(ManifestTest, AMethodThatDoesNotSayIsNotCompiledWhileItRuns) {
  json manifest = good_manifest();
  manifest.erase("jit");
  EXPECT_FALSE(run::load_manifest(write(manifest)).method.jit);
  manifest["jit"] = "yes";
  expect_fault(manifest, "/jit");
}

TEST_F(ManifestTest, FaultsAreSaidWithTheFileAndThePlace) {
  const auto with = [](const std::string& key, const json& value) {
    json manifest = good_manifest();
    manifest[key] = value;
    return manifest;
  };
  expect_fault(with("manifest_version", 2), "/manifest_version");
  expect_fault(with("name", "My-Hull"), "/name");
  expect_fault(with("command", json::array()), "/command");
  expect_fault(with("colour", "blue"), "does not belong there");
  expect_fault(with("runs", {{{"protocol", "guess"}}}), "runs[0].protocol");
  expect_fault(with("runs", {{{"protocol", "auto"}, {"method", "other"}}}), "leave out the key 'method'");
  expect_fault(with("runs", {{{"protocol", "auto"}, {"parameters", {{"k", {{"rule", "paper_alpha"}}}}}}}),
               "reads the ground truth");
  json manifest = good_manifest();
  manifest.erase("citation");
  expect_fault(manifest, "citation");
  manifest = good_manifest();
  manifest["parameters"][1]["name"] = "k";
  expect_fault(manifest, "The parameter 'k' is there twice");
  manifest = good_manifest();
  manifest["parameters"][0]["unit"] = "metres";
  expect_fault(manifest, "/parameters/0/unit");
}

TEST_F(ManifestTest, ValidationSaysWhatContradictsItself) {
  using Faults = std::vector<std::string>;
  json manifest = good_manifest();
  EXPECT_EQ(record::validate_file(write(manifest)), Faults());
  json& parameters = manifest["parameters"];
  parameters[0]["maximum"] = 2;
  parameters[1]["maximum"] = 5;
  EXPECT_EQ(record::validate_file(write(manifest)),
            (Faults{"The parameter 'k' has a minimum above its maximum.",
                    "The parameter 'reach' has a default outside its range."}));
  parameters[0]["maximum"] = 3;
  parameters[1]["default"] = 5;
  EXPECT_EQ(record::validate_file(write(manifest)), Faults());
}

TEST_F(ManifestTest, ARangeMayHaveNoMinimum) {
  json manifest = good_manifest();
  manifest["parameters"][0]["minimum"] = nullptr;
  manifest["parameters"][0]["default"] = -1;
  const run::Manifest loaded = run::load_manifest(write(manifest));
  EXPECT_EQ(loaded.method.info->parameters[0].minimum, -std::numeric_limits<double>::infinity());
}

TEST_F(ManifestTest, AKeyThatStandsTwiceIsRefused) {
  std::string text = good_manifest().dump();
  text.insert(1, R"("title": "Other", )");
  const fs::path file = folder_.path() / "twice.json";
  write_text(file, text);
  EXPECT_EQ(complaint_of<ConfigurationError>([&] { run::load_manifest(file); }),
            "the manifest " + file.string() + " has the key 'title' twice in one object; leave one out");
  EXPECT_EQ(record::validate_file(file),
            std::vector<std::string>{"It has the key 'title' twice in one object; leave one out."});
}

TEST_F(ManifestTest, WhatIsNotJsonAndWhatIsNotThere) {
  write_text(folder_.path() / "broken.json", "{");
  EXPECT_THROW(run::load_manifest(folder_.path() / "broken.json"), ConfigurationError);
  EXPECT_THROW(run::load_manifest(folder_.path() / "none.json"), ConfigurationError);
  EXPECT_THROW(run::load_manifest(folder_.path()), ConfigurationError);
}

TEST_F(ManifestTest, ItsHashIsThatOfTheManifestAndTheProgramBesideIt) {
  write_text(folder_.path() / "my_hull.py", "print(1)");
  const std::string first = run::load_manifest(write(good_manifest())).sha256;
  EXPECT_EQ(run::load_manifest(write(good_manifest())).sha256, first);
  write_text(folder_.path() / "my_hull.py", "print(2)");
  const std::string other_program = run::load_manifest(write(good_manifest())).sha256;
  EXPECT_NE(other_program, first);
  write_text(folder_.path() / "README.md", "About it.");
  EXPECT_EQ(run::load_manifest(write(good_manifest())).sha256, other_program) << "a text decides nothing";
  json manifest = good_manifest();
  manifest["title"] = "Another";
  EXPECT_NE(run::load_manifest(write(manifest)).sha256, other_program);
}

TEST_F(ManifestTest, AFolderIsReadInTheOrderOfItsNames) {
  json other = good_manifest();
  other["name"] = "a_hull";
  write(good_manifest(), "2.json");
  write(other, "3.json");
  write_text(folder_.path() / "package.json", "{}");
  write_text(folder_.path() / "package-lock.json", "{}");
  write_text(folder_.path() / "notes.txt", "{");
  const auto manifests = run::load_manifests({folder_.path(), folder_.path() / "nowhere"});
  ASSERT_EQ(manifests.size(), 2U);
  EXPECT_EQ(manifests[0].method.name, "my_hull");
  EXPECT_EQ(manifests[1].method.name, "a_hull");
  EXPECT_EQ(run::load_manifests({folder_.path(), folder_.path()}).size(), 2U) << "the same ones again";
  other["title"] = "Another method of that name";
  write(other, "4.json");
  EXPECT_THROW(run::load_manifests({folder_.path()}), ConfigurationError);
}

TEST_F(ManifestTest, TheCatalogHasThemAfterTheMethodsThatAreBuiltIn) {
  write(good_manifest());
  const run::MethodCatalog catalog({folder_.path()});
  EXPECT_EQ(catalog.names().front(), "polylidar");
  EXPECT_EQ(catalog.names().back(), "my_hull");
  EXPECT_EQ(catalog.find("my_hull").title, "My hull");
  EXPECT_EQ(catalog.hashes().size(), 1U);
  EXPECT_THROW(catalog.find("nothing"), ConfigurationError);
  EXPECT_EQ(catalog.runs_of("my_hull").size(), 1U);
  EXPECT_THROW(catalog.runs_of("polylidar"), ConfigurationError);
}

TEST_F(ManifestTest, WithoutRunsTheDefaultsAreMeasuredWhenThereAreAll) {
  json manifest = good_manifest();
  manifest.erase("runs");
  write(manifest);
  EXPECT_THROW(run::MethodCatalog({folder_.path()}).runs_of("my_hull"), ConfigurationError);
  manifest["parameters"][0]["default"] = 4;
  write(manifest);
  const std::vector<plan::PlanMethod> runs = run::MethodCatalog({folder_.path()}).runs_of("my_hull");
  ASSERT_EQ(runs.size(), 1U);
  EXPECT_EQ(runs[0].protocol, "default");
  EXPECT_TRUE(runs[0].parameters.empty());
}

TEST_F(ManifestTest, ABuiltInNameIsTaken) {
  json manifest = good_manifest();
  manifest["name"] = "polylidar";
  write(manifest);
  EXPECT_THROW(run::MethodCatalog({folder_.path()}), ConfigurationError);
}

TEST_F(ManifestTest, TheUsersFolderIsWhereItsConfigurationIs) {
  ::setenv("XDG_CONFIG_HOME", folder_.path().c_str(), 1);
  EXPECT_EQ(run::user_manifest_folder(), folder_.path() / "hullbench" / "adapters");
  ::unsetenv("XDG_CONFIG_HOME");
  ::setenv("HOME", folder_.path().c_str(), 1);
  EXPECT_EQ(run::user_manifest_folder(), folder_.path() / ".config" / "hullbench" / "adapters");
  EXPECT_EQ(run::manifest_folders({folder_.path()}).size(), 3U);
  EXPECT_THROW(run::manifest_folders({folder_.path() / "nowhere"}), ConfigurationError);
  ::setenv("HOME", "", 1);
  EXPECT_EQ(run::manifest_folders({}).size(), 1U);
  ::unsetenv("HOME");
  EXPECT_EQ(run::manifest_folders({}).size(), 1U);
  EXPECT_THROW(run::user_manifest_folder(), ConfigurationError);
}

}  // namespace
}  // namespace hullbench::testing
