#include "adapters/adapter_module.hpp"

#include <dlfcn.h>

#include <filesystem>
#include <string>
#include <system_error>

namespace hullbench {
namespace {

// "why it failed", of the last call of the loader.
std::string complaint() {
  const char* message = dlerror();
  return message == nullptr ? "no reason given" : message;
}

// Of an installed program PREFIX/bin/NAME the library of that name in PREFIX/lib/hullbench, even where it is
// not there: it must not load what somebody has put where it was built. Else `file` itself.
std::string installed_or(const char* file) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path folder = program.parent_path().parent_path() / "lib" / "hullbench";
  return fs::is_directory(folder, error) ? (folder / fs::path(file).filename()).string() : file;
}

}  // namespace

std::unique_ptr<Adapter> load_adapter_module(const char* file, const char* install) {
  void* module = dlopen(installed_or(file).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (module == nullptr) throw NotInstalled("the method's library cannot be loaded: " + complaint(), install);
  void* maker = dlsym(module, "hullbench_make_adapter");
  if (maker == nullptr)
    throw NotInstalled("the method's library is of another build: " + complaint(), install);
  return std::unique_ptr<Adapter>(reinterpret_cast<Adapter* (*)()>(maker)());
}

}  // namespace hullbench
