#include "datasets/data_folder.hpp"

#include <system_error>

namespace hullbench {

namespace fs = std::filesystem;

const fs::path& data_folder() {
  static const fs::path folder = [] {
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    const fs::path installed = program.parent_path().parent_path() / "share" / "hullbench";
    return fs::is_directory(installed, error) ? installed : fs::path(HULLBENCH_SOURCE_FOLDER);
  }();
  return folder;
}

}  // namespace hullbench
