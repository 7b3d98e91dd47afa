// Writes the report of the invented run, for checks by other programs: write_invented_report FILE [N...]
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <vector>

#include "benchmarks/base/files.hpp"
#include "benchmarks/report/report.hpp"
#include "benchmarks/report/tables.hpp"
#include "benchmarks/table/writers.hpp"
#include "invented_run.hpp"

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: write_invented_report FILE [N...]\n";
    return 2;
  }
  const std::filesystem::path file = argv[1];
  std::vector<std::int64_t> sizes;
  for (int index = 2; index < argc; ++index) sizes.push_back(std::stoll(argv[index]));
  if (sizes.empty()) sizes = {2000, 64000};
  const std::filesystem::path directory = file.parent_path() / (file.stem().string() + "_run");
  hullbench::testing::write_invented_run(directory, sizes);
  const nlohmann::json report = hullbench::report::make_report(directory);
  hullbench::write_json_file(file, report);
  hullbench::table::print_markdown(hullbench::report::make_document(report), std::cout);
  return 0;
}
