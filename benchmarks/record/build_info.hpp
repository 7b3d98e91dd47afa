// How this program was built, as CMake knew it. The values are in a generated file (build_info.cpp.in).
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace hullbench::record {

struct BuildInfo {
  std::string compiler_id;
  std::string compiler_version;
  std::string build_type;
  bool native = false;  ///< compiled for the builder's processor instead of generic x86-64
  std::string flags;    ///< CMake's own, for every target
  std::vector<std::pair<std::string, std::string>>
      target_options;                                          ///< what each measured target adds, by target
  std::vector<std::pair<std::string, std::string>> libraries;  ///< version by name
};

const BuildInfo& build_info();

}  // namespace hullbench::record
