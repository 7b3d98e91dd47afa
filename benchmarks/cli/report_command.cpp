// `hullbench report`
#include <iostream>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/files.hpp"
#include "benchmarks/cli/options.hpp"
#include "benchmarks/cli/run_folder.hpp"
#include "benchmarks/record/pictures.hpp"
#include "benchmarks/record/stored_run.hpp"
#include "benchmarks/report/report.hpp"

namespace hullbench::cli {
namespace {

struct ReportCommand {
  std::string run = "results/latest";
  fs::path out;
};

/// Writes what figures and the HTML report are made from: report.json and the pictures of the run, or of each
/// run of a suite in a folder of its name.
ExitCode write_reports(const ReportCommand& command) {
  check_run_folder(command.run);
  const bool suite = record::is_suite(command.run);
  for (const fs::path& run : record::runs_in(command.run)) {
    const fs::path folder = suite ? command.out / run.filename() : command.out;
    make_writable_folder(folder);
    if (fs::equivalent(folder, run))
      throw ConfigurationError("the folder " + folder.string() +
                               " is the run itself; choose another one with --out");
    report::write_report_file(folder / record::kReportFile, report_to_share(run));
    fs::remove(folder / record::kPicturesFile);
    record::merge_pictures({run}, folder);
    std::cout << "wrote " << (folder / record::kReportFile).string() << "\n";
  }
  return kExitOk;
}

}  // namespace

void add_report(CLI::App& app, Action& action) {
  const auto command = std::make_shared<ReportCommand>();
  CLI::App& options = add_command(
      app, "report", "Write what figures and pages are drawn from: a run's report.json and pictures",
      "hullbench report results/latest --out drawn");
  options.add_option("RUN", command->run, "The folder of a run, or of a suite")->capture_default_str();
  options.add_option("--out", command->out, "Folder to write into")->required();
  set_action(options, action, command, &write_reports);
}

}  // namespace hullbench::cli
