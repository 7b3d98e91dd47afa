// Tests of the whole program, each in a folder of its own.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/record/json_lines.hpp"
#include "tests/program.hpp"
#include "tests/small_plans.hpp"
#include "tests/temporary_folder.hpp"

namespace hullbench::testing {

class HullbenchTest : public ::testing::Test {
 protected:
  fs::path folder() const { return folder_.path(); }

  static std::vector<std::string> command(const std::vector<std::string>& arguments) {
    return joined({HULLBENCH}, arguments);
  }

  /// In the test's folder, unless `options` name another, with manifests of its own.
  ProgramOptions in_folder(ProgramOptions options = {}) const {
    if (options.folder.empty()) options.folder = folder();
    options.environment.try_emplace("XDG_CONFIG_HOME", folder() / "config");
    // The developer's own servers.
    for (const char* name : {"HULLBENCH_POSTGIS_DSN", "HULLBENCH_POSTGIS_LEGACY_DSN"})
      options.environment.try_emplace(name, "");
    return options;
  }

  Outcome hullbench(const std::vector<std::string>& arguments, const ProgramOptions& options = {}) const {
    return run_program(command(arguments), in_folder(options));
  }

  /// A line in a shell that finds our programs, in the test's folder.
  Outcome shell(const std::string& line, const ProgramOptions& options = {}) const {
    const std::string path = "PATH='" + fs::path(HULLBENCH).parent_path().string() + "':$PATH; ";
    return run_program({"/bin/sh", "-c", path + line}, in_folder(options));
  }

  /// Writes the plan into a file; its path.
  std::string write(const json& plan) const { return write_plan(folder(), plan); }

  json read_json(const fs::path& file) const { return json::parse(read_text(folder() / file)); }

  std::vector<json> read_lines(const fs::path& file) const {
    return record::load_json_lines(folder() / file).lines;
  }

  /// Writes the file anew after `change`.
  void change_json(const fs::path& file, const std::function<void(json&)>& change) const {
    json content = read_json(file);
    change(content);
    write_text(folder() / file, content.dump());
  }

  /// Writes the rows of a run anew, each after `change`.
  void change_rows(const fs::path& run, const std::function<void(json&)>& change) const {
    std::string text;
    for (json row : read_lines(run / "runs.jsonl")) {
      change(row);
      text += row.dump() + "\n";
    }
    write_text(folder() / run / "runs.jsonl", text);
  }

  void expect_valid(const std::string& file) const { succeeded(hullbench({"validate", file})); }

 private:
  TemporaryFolder folder_;
};

}  // namespace hullbench::testing
