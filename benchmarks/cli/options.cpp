#include "benchmarks/cli/options.hpp"

#include <unistd.h>

#include <charconv>
#include <cstdint>
#include <system_error>

#include "benchmarks/base/configuration_error.hpp"

namespace hullbench::cli {

CLI::App& add_command(CLI::App& app, const std::string& name, const std::string& description,
                      const std::string& example) {
  CLI::App* options = app.add_subcommand(name, description);
  options->footer("Example: " + example + "\n" + kExitCodesHelp);
  return *options;
}

void add_plans(CLI::App& options, std::vector<std::string>& plans, const std::string& meaning) {
  options
      .add_option("PLAN", plans, "A plan's name (benchmarks/plans) or the path of its JSON file" + meaning)
      ->required();
}

void add_adapters(CLI::App& options, std::vector<fs::path>& folders) {
  options
      .add_option("--adapters", folders,
                  "Also look for methods in this folder of manifests (adapters/process/PROTOCOL.md), besides "
                  "adapters/manifests and ~/.config/hullbench/adapters")
      ->allow_extra_args(false);
}

void add_shard(CLI::App& options, std::optional<run::Shard>& shard, const std::string& meaning) {
  options.add_option_function<std::string>(
      "--shard", [&shard](const std::string& text) { shard = run::parse_shard(text); }, meaning);
}

void add_export_gbench(CLI::App& options, fs::path& file) {
  options.add_option("--export-gbench", file,
                     "Also write the times into this file, as Google Benchmark's JSON");
}

CLI::Validator timeout_range() {
  return {[](const std::string& text) -> std::string {
            double seconds = 0;
            const bool is_number = CLI::detail::lexical_cast(text, seconds);
            if (is_number && seconds >= 0.001 && seconds <= 1e6) return "";  // NaN is not
            return "'" + text + "' is no number of seconds from 0.001 to 1000000";
          },
          "FLOAT in [0.001 - 1e+06]"};
}

CLI::Validator seed_range() {
  return {[](const std::string& text) -> std::string {
            std::uint64_t seed = 0;
            const char* const end = text.data() + text.size();
            const auto [parsed, error] = std::from_chars(text.data(), end, seed);
            if (error == std::errc() && parsed == end) return "";
            return "'" + text + "' is no whole number from 0 to 18446744073709551615";
          },
          "UINT"};
}

CLI::Range memory_range() {
  return {std::int64_t{64}, std::int64_t{1} << 30};
}

void check_export_place(const fs::path& file) {
  if (file.empty()) return;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (fs::is_directory(file) || ::access(folder.c_str(), W_OK) != 0) {
    throw ConfigurationError("cannot write " + file.string() +
                             "; give --export-gbench a file in a folder that is there and writable");
  }
}

}  // namespace hullbench::cli
