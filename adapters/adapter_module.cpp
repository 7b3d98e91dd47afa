#include "adapters/adapter_module.hpp"

#include <dlfcn.h>

#include <string>

namespace hullbench {
namespace {

// "why it failed", of the last call of the loader.
std::string complaint() {
  const char* message = dlerror();
  return message == nullptr ? "no reason given" : message;
}

}  // namespace

std::unique_ptr<Adapter> load_adapter_module(const char* file, const char* install) {
  void* module = dlopen(file, RTLD_NOW | RTLD_LOCAL);
  if (module == nullptr) throw NotInstalled("the method's library cannot be loaded: " + complaint(), install);
  void* maker = dlsym(module, "hullbench_make_adapter");
  if (maker == nullptr)
    throw NotInstalled("the method's library is of another build: " + complaint(), install);
  return std::unique_ptr<Adapter>(reinterpret_cast<Adapter* (*)()>(maker)());
}

}  // namespace hullbench
