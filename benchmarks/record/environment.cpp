#include "benchmarks/record/environment.hpp"

#include <gnu/libc-version.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>
#include <vector>

#include "benchmarks/base/cores.hpp"
#include "benchmarks/base/huge_pages.hpp"
#include "benchmarks/base/words.hpp"
#include "benchmarks/record/build_info.hpp"
#include "benchmarks/record/record.hpp"

namespace hullbench::record {
namespace {

std::optional<std::string> first_line(const fs::path& path) {
  std::ifstream in(path);
  std::string line;
  if (!std::getline(in, line)) return std::nullopt;
  return line;
}

/// The value of the first line "key<blanks><separator> value" of a file such as /proc/cpuinfo, quotes
/// removed.
std::optional<std::string> value_of_key(const fs::path& path, std::string_view key, char separator) {
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    const std::size_t place = line.find(separator);
    if (place == std::string::npos || line.rfind(key, 0) != 0) continue;
    if (line.find_first_not_of(" \t", key.size()) != place) continue;
    std::string value = line.substr(place + 1);
    std::erase(value, '"');
    const std::size_t begin = value.find_first_not_of(" \t");
    return begin == std::string::npos ? std::string() : value.substr(begin);
  }
  return std::nullopt;
}

template <typename T>
json or_null(const std::optional<T>& value) {
  return value ? json(*value) : json(nullptr);
}

std::string architecture() {
  utsname name{};
  return uname(&name) == 0 ? name.machine : "unknown";
}

std::string cpu_model() {
  return value_of_key("/proc/cpuinfo", "model name", ':').value_or(architecture());
}

std::int64_t memory_bytes() {
  return static_cast<std::int64_t>(sysconf(_SC_PHYS_PAGES)) *
         static_cast<std::int64_t>(sysconf(_SC_PAGESIZE));
}

/// Whether the processor says that it runs under a hypervisor; unknown where it has no such flag (not x86).
std::optional<bool> virtualised() {
  const std::optional<std::string> flags = value_of_key("/proc/cpuinfo", "flags", ':');
  if (!flags) return std::nullopt;
  std::istringstream words(*flags);
  for (std::string word; words >> word;) {
    if (word == "hypervisor") return true;
  }
  return false;
}

std::optional<bool> boost() {
  const fs::path cpus = "/sys/devices/system/cpu";
  if (const auto no_turbo = first_line(cpus / "intel_pstate" / "no_turbo")) return *no_turbo == "0";
  if (const auto boosted = first_line(cpus / "cpufreq" / "boost")) return *boosted == "1";
  return std::nullopt;
}

json governors() {
  std::set<std::string> found;
  const long cores = sysconf(_SC_NPROCESSORS_CONF);
  for (long core = 0; core < cores; ++core) {
    const std::string path =
        "/sys/devices/system/cpu/cpu" + std::to_string(core) + "/cpufreq/scaling_governor";
    if (const auto governor = first_line(path)) found.insert(*governor);
  }
  return found.empty() ? json(nullptr) : json(found);
}

json core_count() {
  const std::size_t count = allowed_cores().size();
  return count == 0 ? json(nullptr) : json(count);
}

json load_average() {
  std::array<double, 3> load{};
  return getloadavg(load.data(), 3) == 3 ? json(load) : json(nullptr);
}

/// Of the hottest sensor, in degrees Celsius; null where the system shows none, as in most virtual machines.
json temperature() {
  std::optional<double> hottest;
  std::error_code ignored;
  for (const auto& zone : fs::directory_iterator("/sys/class/thermal", ignored)) {
    const auto millidegrees = first_line(zone.path() / "temp");
    if (!millidegrees || zone.path().filename().string().rfind("thermal_zone", 0) != 0) continue;
    hottest = std::max(hottest, std::optional(std::strtod(millidegrees->c_str(), nullptr) / 1000));
  }
  return or_null(hottest);
}

json address_space_randomisation() {
  const auto value = first_line("/proc/sys/kernel/randomize_va_space");
  return value && value->size() == 1 ? json(value->front() - '0') : json(nullptr);
}

json kernel() {
  utsname name{};
  if (uname(&name) != 0) return nullptr;
  return std::string(name.sysname) + " " + name.release;
}

/// Flags without warnings, which change no code, and without those that hold a path, which would tell whose
/// machine it was.
std::vector<std::string> code_flags(const std::string& flags) {
  std::vector<std::string> result;
  std::istringstream words(flags);
  for (std::string word; words >> word;) {
    if (word.find('/') == std::string::npos && word.rfind("-W", 0) != 0) result.push_back(word);
  }
  return result;
}

std::vector<std::string> missing_in(const std::vector<std::string>& words,
                                    const std::vector<std::string>& other) {
  std::vector<std::string> result;
  std::ranges::copy_if(words, std::back_inserter(result),
                       [&](const std::string& word) { return std::ranges::count(other, word) == 0; });
  return result;
}

/// Says whether every measured target has the same flags, and if not, which differ. CGAL's package adds one
/// of its own, because its interval arithmetic changes the rounding mode.
std::string flags_statement(const BuildInfo& info) {
  std::string differences;
  const std::vector<std::string> ours = info.target_options.empty()
                                            ? std::vector<std::string>()
                                            : code_flags(info.target_options.front().second);
  for (const auto& [target, options] : info.target_options) {
    const std::vector<std::string> theirs = code_flags(options);
    const std::vector<std::string> added = missing_in(theirs, ours);
    const std::vector<std::string> lacking = missing_in(ours, theirs);
    if (!added.empty()) differences += "; " + target + " adds " + joined(added, " ");
    if (!lacking.empty()) differences += "; " + target + " lacks " + joined(lacking, " ");
  }
  const bool asked_by_cgal = differences.find("-frounding-math") != std::string::npos;
  return "The core, every adapter and the header-only libraries compiled into them (CGAL) are built with the "
         "same compiler and flags" +
         (differences.empty() ? std::string(", without exception.")
                              : ", except: " + differences.substr(2) + ".") +
         (asked_by_cgal ? " CGAL's own package adds -frounding-math to whatever uses it." : "") +
         " The core chooses its loops for AVX2 or AVX-512 at run time.";
}

json compiler() {
  const BuildInfo& info = build_info();
  json by_target = json::object();
  for (const auto& [target, options] : info.target_options)
    by_target[target] = joined(code_flags(options), " ");
  return {{"id", info.compiler_id},
          {"version", info.compiler_version},
          {"build_type", info.build_type},
          {"native", info.native},
          {"flags", joined(code_flags(info.flags), " ")},
          {"flags_by_target", by_target},
          {"statement", flags_statement(info)}};
}

json libraries() {
  json result = json::object();
  for (const auto& [name, version] : build_info().libraries) result[name] = version;
  result["nlohmann-json"] = std::to_string(NLOHMANN_JSON_VERSION_MAJOR) + "." +
                            std::to_string(NLOHMANN_JSON_VERSION_MINOR) + "." +
                            std::to_string(NLOHMANN_JSON_VERSION_PATCH);
  result["glibc"] = gnu_get_libc_version();
  result["libstdc++"] = std::to_string(_GLIBCXX_RELEASE);
  return result;
}

}  // namespace

std::string machine_id(const std::string& model, long logical_cores, long memory_gib) {
  return sha256_hex(model + "|" + std::to_string(logical_cores) + "|" + std::to_string(memory_gib))
      .substr(0, 8);
}

std::string machine_id() {
  return machine_id(cpu_model(), sysconf(_SC_NPROCESSORS_ONLN), static_cast<long>(memory_bytes() >> 30));
}

json collect_environment() {
  return {{"machine_id", machine_id()},
          {"cpu",
           {{"model", cpu_model()},
            {"architecture", architecture()},
            {"logical_cores", sysconf(_SC_NPROCESSORS_ONLN)},
            {"allowed_cores", core_count()},
            {"governors", governors()},
            {"boost", or_null(boost())},
            {"virtualised", or_null(virtualised())}}},
          {"memory_bytes", memory_bytes()},
          {"load_average", load_average()},
          {"temperature_celsius", temperature()},
          {"aslr", address_space_randomisation()},
          {"huge_pages", huge_pages()},
          {"kernel", kernel()},
          {"os", or_null(value_of_key("/etc/os-release", "PRETTY_NAME", '='))},
          {"compiler", compiler()},
          {"libraries", libraries()}};
}

}  // namespace hullbench::record
