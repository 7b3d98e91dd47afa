// Where the files are that the program reads when it runs: shapes, plans, manifests.
#pragma once

#include <filesystem>

namespace hullbench {

/// Of an installed program PREFIX/bin/NAME the folder PREFIX/share/hullbench, so that PREFIX may be moved; of
/// any other the project's top folder, as it was when the program was built. Both have the same folders
/// below.
const std::filesystem::path& data_folder();

}  // namespace hullbench
