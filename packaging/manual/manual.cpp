#include "packaging/manual/manual.hpp"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace packaging {
namespace {

namespace fs = std::filesystem;

void write_file(const fs::path& file, const std::string& text) {
  errno = 0;
  std::ofstream out(file, std::ios::binary);
  out << text << std::flush;
  if (out.good()) return;
  const int error = errno;  // the stream does not say why
  throw std::runtime_error("cannot write " + file.string() +
                           (error == 0 ? "" : ": " + std::generic_category().message(error)));
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw std::runtime_error("cannot make the folder " + folder.string() + ": " + error.message());
}

}  // namespace

void add_manual(CLI::App& program, const std::string& version, const MoreWords& more) {
  const auto write = [&program, version, more](const std::string& name) {
    // CLI11 would complain of a missing value without the name of the option, as it is hidden.
    if (name.empty()) throw CLI::ArgumentMismatch("--write-manual needs the name of a folder");
    const fs::path folder(name);
    make_folder(folder);
    for (const auto& [file, text] : man_pages(program, version)) write_file(folder / file, text);
    write_file(folder / program.get_name(), bash_completion(program, more));
    write_file(folder / ("_" + program.get_name()), zsh_completion(program, more));
    throw CLI::Success();
  };
  program
      .add_option_function<std::string>("--write-manual", write,
                                        "Write the man pages and the completion of shells into this folder")
      ->expected(0, 1)
      ->group("");
}

}  // namespace packaging
