#include "benchmarks/base/huge_pages.hpp"

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace hullbench {
namespace {

constexpr std::string_view kHugetlb = "glibc.malloc.hugetlb";

/// The setting of `name` in `tunables`, with its name; empty when there is none. The last one counts.
std::string setting_of(std::string_view name, std::string_view tunables) {
  std::string found;
  std::istringstream settings{std::string(tunables)};
  for (std::string setting; std::getline(settings, setting, ':');) {
    if (setting.starts_with(std::string(name) + "=")) found = setting;
  }
  return found;
}

std::string_view own_tunables() {
  const char* own = std::getenv(std::string(kTunablesVariable).c_str());
  return own == nullptr ? std::string_view() : own;
}

/// The word in brackets of "always [madvise] never".
json kernel_policy() {
  std::ifstream file("/sys/kernel/mm/transparent_hugepage/enabled");
  for (std::string word; file >> word;) {
    if (word.front() == '[' && word.back() == ']') return word.substr(1, word.size() - 2);
  }
  return nullptr;
}

}  // namespace

std::string worker_tunables(std::string_view own) {
  std::string result(own);
  if (!setting_of(kHugetlb, own).empty()) return result;
  return result + (own.empty() ? "" : ":") + std::string(kHugetlb) + "=1";
}

json huge_pages() {
  return {{"kernel", kernel_policy()}, {"malloc", setting_of(kHugetlb, worker_tunables(own_tunables()))}};
}

}  // namespace hullbench
