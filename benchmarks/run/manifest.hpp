// Manifests: methods in any language, described by a JSON file each. adapters/process/PROTOCOL.md says what
// is in one, adapters/process/manifest.schema.json is its schema.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/plan/plan.hpp"
#include "benchmarks/worker/method.hpp"

namespace hullbench::run {

struct Manifest {
  worker::Method method;
  fs::path file;
  std::string sha256;  ///< of the manifest, the files of its command and those in their folder
  std::vector<plan::PlanMethod> runs;  ///< how to measure it in a plan that does not name it
};

/// What a method is made of has at most so many bytes; anything larger beside a manifest is data.
inline constexpr std::uintmax_t kLargestProgram = 1 << 20;

/// Whether this is a manifest, by its name: npm has two files of its own beside the methods.
bool is_manifest(const fs::path& file);

/// The manifest in `file`. Words of the command and files needed that begin with "./" or "../" are taken from
/// the manifest's folder. Throws ConfigurationError, one sentence, when it cannot be read or has a fault.
Manifest load_manifest(const fs::path& file);

/// All manifests (*.json) in the folders, by folder and then by name. A folder that is not there has none.
/// Throws ConfigurationError when one has a fault or two have the same name.
std::vector<Manifest> load_manifests(const std::vector<fs::path>& folders);

}  // namespace hullbench::run
