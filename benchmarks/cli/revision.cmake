# Writes OUTPUT, the definition of hullbench::cli::revision() for the checkout SOURCE; run at every build, touches the file only when it
# changes. The program must say what it was built from, not what lies in the folder when it runs.
cmake_minimum_required(VERSION 3.25)

execute_process(COMMAND git -C "${SOURCE}" rev-parse HEAD
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
# Sources that lie in another project's checkout have no commit.
execute_process(COMMAND git -C "${SOURCE}" rev-parse --show-prefix
  OUTPUT_VARIABLE folder OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(failed OR NOT folder STREQUAL "")
  set(values "std::nullopt, std::nullopt")
else()
  execute_process(COMMAND git -C "${SOURCE}" --no-optional-locks status --porcelain --untracked-files=no
    OUTPUT_VARIABLE changes ERROR_QUIET)
  if(changes STREQUAL "")
    set(dirty false)
  else()
    set(dirty true)
  endif()
  set(values "\"${commit}\", ${dirty}")
endif()
file(CONFIGURE OUTPUT "${OUTPUT}" @ONLY CONTENT
"#include \"benchmarks/cli/revision.hpp\"

namespace hullbench::cli {

Revision revision() { return {@values@}; }

}  // namespace hullbench::cli
")
