// The revision of the sources that this program was built from. The values are written at build time
// (revision.cmake).
#pragma once

#include <optional>
#include <string>

namespace hullbench::cli {

struct Revision {
  std::optional<std::string>
      commit;  ///< lower-case hex; none when built outside a git checkout or before its first commit
  std::optional<bool> dirty;  ///< whether tracked files differed from it; none as above
};

Revision revision();

}  // namespace hullbench::cli
