// `hullbench adapter new` and `hullbench adapter test`: a method from its first file to a kept contract.
#include <algorithm>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <optional>
#include <system_error>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/files.hpp"
#include "benchmarks/base/scratch_folder.hpp"
#include "benchmarks/cli/options.hpp"
#include "benchmarks/run/contract.hpp"
#include "benchmarks/run/method_catalog.hpp"
#include "datasets/data_folder.hpp"

namespace hullbench::cli {
namespace {

const fs::path kSkeletons = data_folder() / "benchmarks" / "skeletons";
const fs::path kHelpers = data_folder() / "adapters" / "process";

struct NewAdapterCommand {
  std::string name;
  std::string language;         ///< "cpp", "python" or "js"
  std::optional<fs::path> out;  ///< none: where hullbench finds it, see new_adapter
};

struct TestAdapterCommand {
  std::string name;
  std::vector<fs::path> adapters;     ///< more folders with manifests
  double timeout_s = 60;              ///< for one run
  std::int64_t mem_limit_mib = 4096;  ///< address space of the worker
  std::size_t many_points = 20'000;   ///< of the largest set
};

std::string replace_all(std::string text, const std::string& what, const std::string& with) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size())) {
    text.replace(at, what.size(), with);
  }
  return text;
}

/// A file to be written, all of them checked before the first one is.
struct NewFile {
  fs::path path;
  std::string text;
  bool append = false;  ///< to a file that may be there
  bool shared = false;  ///< the same for every method of the folder, so that it may be there
};

std::vector<NewFile> cpp_files(const NewAdapterCommand& command) {
  const fs::path folder = command.out.value_or(data_folder() / "adapters");
  const std::string line = "add_adapter(NAME " + command.name + " TITLE \"" + command.name + "\")\n";
  return {{folder / (command.name + ".cpp"),
           replace_all(required_text(kSkeletons / "skeleton.cpp.in"), "@NAME@", command.name)},
          {folder / "adapters.cmake", line, true}};
}

std::vector<NewFile> script_files(const NewAdapterCommand& command) {
  const fs::path folder = command.out ? *command.out : run::user_manifest_folder();
  const bool python = command.language == "python";
  const std::string ending = python ? ".py" : ".mjs";
  // Not NAME.py, which would hide a module of that name from every method of the folder.
  const std::string script = command.name + "_worker" + ending;
  const std::string words = (python ? R"("python3", "./)" : R"("node", "--expose-gc", "./)") + script + "\"";
  const std::string helper = "hullbench_worker" + ending;
  std::string manifest = replace_all(required_text(kSkeletons / "skeleton.json"), "@NAME@", command.name);
  manifest = replace_all(manifest, "@COMMAND@", words);
  manifest = replace_all(manifest, "@JIT@", python ? "false" : "true");
  manifest =
      replace_all(manifest, "@INSTALL@",
                  python ? "sudo apt-get install python3-numpy; for a Python of your own: python3 -m pip "
                           "install numpy"
                         : "sudo apt-get install nodejs");
  return {{folder / (command.name + ".json"), manifest},
          {folder / script, required_text(kSkeletons / ("skeleton" + ending))},
          {folder / helper, required_text(kHelpers / helper), false, true}};
}

void check_name(const std::string& name) {
  const bool good =
      !name.empty() && name.front() >= 'a' && name.front() <= 'z' && std::ranges::all_of(name, [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
      });
  if (!good) {
    throw ConfigurationError(
        "a method's name has small letters, digits and '_' and begins with a letter, not '" + name + "'");
  }
  const run::MethodCatalog catalog(run::manifest_folders({}));
  const std::vector<std::string> names = catalog.names();
  // The worker of "hullbench" would have the name of the helper file.
  if (name == "hullbench" || std::ranges::find(names, name) != names.end()) {
    throw ConfigurationError("there is a method '" + name + "' already; choose another name");
  }
}

void write(const NewFile& file) {
  std::ofstream out(file.path, std::ios::binary | (file.append ? std::ios::app : std::ios::trunc));
  out << file.text;
  out.close();
  if (!out) throw std::runtime_error("cannot write " + file.path.string());
}

void write_all(const std::vector<NewFile>& files) {
  for (const NewFile& file : files) {
    if (!file.append && !file.shared && fs::exists(file.path)) {
      throw ConfigurationError("the file " + file.path.string() +
                               " is there already; remove it or choose another name");
    }
  }
  std::error_code error;
  fs::create_directories(files.front().path.parent_path(), error);
  if (error) {
    throw ConfigurationError("cannot make the folder " + files.front().path.parent_path().string() + ": " +
                             error.message());
  }
  for (const NewFile& file : files) {
    const bool is_there = fs::exists(file.path);
    if (file.shared && is_there) continue;
    write(file);
    std::cout << (is_there ? "added a line to " : "wrote ") << file.path.string() << "\n";
  }
}

void print(const run::Verdict& verdict) {
  std::cout << (verdict.kept ? "ok    " : "FAIL  ") << std::left << std::setw(30) << verdict.name << " "
            << verdict.words << std::endl;
}

/// Writes a method that works: the convex hull, with the place to put another one. In C++ the file
/// adapters/NAME.cpp of this project and its line in adapters/adapters.cmake; in Python and JavaScript the
/// manifest, the worker and a copy of its helper file, into the user's configuration folder. With --out all
/// of it goes there, and the CMake line into a file adapters.cmake there. Nothing is overwritten.
ExitCode new_adapter(const NewAdapterCommand& command) {
  check_name(command.name);
  const bool cpp = command.language == "cpp";
  write_all(cpp ? cpp_files(command) : script_files(command));
  std::string next = "hullbench adapter test " + command.name;
  if (command.out && !cpp) next += " --adapters " + command.out->string();
  std::cout << "next: put the method in its place, " << (cpp ? "'make build', " : "") << "then '" << next
            << "'\n";
  return kExitOk;
}

/// Tries the contract (contract.hpp) and prints a verdict a line.
ExitCode test_adapter(const TestAdapterCommand& command) {
  const run::MethodCatalog catalog(run::manifest_folders(command.adapters));
  const worker::Method& method = catalog.find(command.name);
  const ScratchFolder scratch("hullbench-contract");
  const auto timeout = std::chrono::milliseconds(static_cast<std::int64_t>(command.timeout_s * 1000));
  const std::vector<run::Verdict> verdicts = run::test_contract(
      method, {{command.mem_limit_mib, std::nullopt}, timeout, command.many_points}, scratch.path(), &print);
  const auto kept = std::ranges::count_if(verdicts, [](const run::Verdict& verdict) { return verdict.kept; });
  if (verdicts.back().status == record::Status::kNotInstalled) return kExitNothing;
  const bool all = kept == static_cast<std::ptrdiff_t>(verdicts.size());
  std::cout << command.name << " keeps " << (all ? "the contract: " : "part of the contract: ") << kept
            << " of " << verdicts.size() << " points\n";
  return all ? kExitOk : kExitFailures;
}

void add_new(CLI::App& app, Action& action) {
  const auto command = std::make_shared<NewAdapterCommand>();
  CLI::App& options = add_command(app, "new", "Write a small working method, to be changed into yours",
                                  "hullbench adapter new my_hull --lang python --out methods");
  options.add_option("NAME", command->name, "The method's name: small letters, digits and _")->required();
  options.add_option("--lang", command->language, "The language to write it in")
      ->check(CLI::IsMember({"cpp", "python", "js"}))
      ->required();
  options.add_option(
      "--out", command->out,
      "Folder for the new files, instead of adapters/ (cpp) or ~/.config/hullbench/adapters (python, js)");
  set_action(options, action, command, &new_adapter);
}

void add_test(CLI::App& app, Action& action) {
  const auto command = std::make_shared<TestAdapterCommand>();
  CLI::App& options = add_command(app, "test", "Check a method against each point of the contract",
                                  "hullbench adapter test my_hull --adapters methods");
  options.add_option("NAME", command->name, "The method's name")->required();
  add_adapters(options, command->adapters);
  options.add_option("--timeout", command->timeout_s, "Time limit of one run in seconds")
      ->check(timeout_range())
      ->capture_default_str();
  options
      .add_option("--mem-limit", command->mem_limit_mib, "Memory limit of the method (address space) in MiB")
      ->check(memory_range())
      ->capture_default_str();
  options
      .add_option("--points", command->many_points,
                  "Points of the largest set; fewer are enough for a method that takes long")
      ->check(CLI::Range(1'000, 1'000'000))
      ->capture_default_str();
  set_action(options, action, command, &test_adapter);
}

}  // namespace

void add_adapter(CLI::App& app, Action& action) {
  CLI::App& options = add_command(app, "adapter", "Add a method, or check one",
                                  "hullbench adapter new my_hull --lang python --out methods");
  options.require_subcommand(1);
  add_new(options, action);
  add_test(options, action);
}

}  // namespace hullbench::cli
