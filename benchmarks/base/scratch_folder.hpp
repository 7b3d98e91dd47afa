// A folder that is there as long as it is needed.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>

namespace hullbench {

/// A folder of its own among the system's temporary files, removed with everything in it when the object
/// goes.
class ScratchFolder {
 public:
  /// `name` is what its name begins with. Throws std::runtime_error when it cannot be made.
  explicit ScratchFolder(const std::string& name)
      : path_((std::filesystem::temp_directory_path() / (name + "-XXXXXX")).string()) {
    if (!::mkdtemp(path_.data())) throw std::runtime_error("cannot make a folder like " + path_);
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::filesystem::path path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace hullbench
