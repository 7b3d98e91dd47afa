#include "benchmarks/cli/tool_description.hpp"

#include "benchmarks/cli/revision.hpp"
#include "datasets/sha256.hpp"

namespace hullbench::cli {

json describe_tool() {
  const Revision built_from = revision();
  return {{"name", "hullbench"},
          {"version", HULLBENCH_VERSION},
          {"commit", built_from.commit ? json(*built_from.commit) : json(nullptr)},
          {"dirty", built_from.dirty ? json(*built_from.dirty) : json(nullptr)},
          {"binary_sha256", sha256_file("/proc/self/exe")}};
}

}  // namespace hullbench::cli
