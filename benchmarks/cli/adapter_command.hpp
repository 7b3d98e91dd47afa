// `hullbench adapter new` and `hullbench adapter test`: a method from its first file to a kept contract.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hullbench::cli {

/// The command line of `adapter new`.
struct NewAdapterCommand {
  std::string name;
  std::string language;                      ///< "cpp", "python" or "js"
  std::optional<std::filesystem::path> out;  ///< none: where hullbench finds it, see new_adapter_command
};

/// Writes a method that works: the convex hull, with the place to put another one. In C++ the file
/// adapters/NAME.cpp of this project and its line in adapters/adapters.cmake; in Python and JavaScript the
/// manifest, the worker and a copy of its helper file, into the user's configuration folder. With `out` all
/// of it goes there, and the CMake line into a file adapters.cmake there. Says what it wrote and what comes
/// next. Throws ConfigurationError when the name is taken or none, or a file is there already; nothing is
/// overwritten.
int new_adapter_command(const NewAdapterCommand& command);

/// The command line of `adapter test`.
struct TestAdapterCommand {
  std::string name;
  std::vector<std::filesystem::path> adapters;  ///< more folders with manifests
  double timeout_s = 60;                        ///< for one run
  std::int64_t mem_limit_mib = 4096;            ///< address space of the worker
};

/// Tries the contract (contract.hpp) and prints a verdict a line. Returns 0 when all of it is kept, 4 when
/// not, 6 when the method is not installed.
int test_adapter_command(const TestAdapterCommand& command);

}  // namespace hullbench::cli
