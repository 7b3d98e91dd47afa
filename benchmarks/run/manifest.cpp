#include "benchmarks/run/manifest.hpp"

#include <algorithm>
#include <optional>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/files.hpp"
#include "benchmarks/record/validate.hpp"
#include "benchmarks/worker/protocol.hpp"
#include "datasets/sha256.hpp"

namespace hullbench::run {
namespace {

bool is_beside(const std::string& word) {
  return word.starts_with("./") || word.starts_with("../");
}

std::string resolved(const std::string& word, const fs::path& folder) {
  return is_beside(word) ? (folder / word).lexically_normal().string() : word;
}

std::vector<std::string> resolved_words(const json& manifest, const char* key, const fs::path& folder) {
  std::vector<std::string> words;
  for (const json& word : manifest.value(key, json::array())) {
    words.push_back(resolved(word.get<std::string>(), folder));
  }
  return words;
}

MethodInfo info_of(json manifest) {
  manifest["version"] = "";
  return worker::method_from_json(manifest);
}

/// The hashes of the files in `folder` that are no manifests, no data and no texts (.md): what a method there
/// may be made of.
std::vector<std::string> program_hashes(const fs::path& folder) {
  std::vector<std::string> hashes;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.is_regular_file(ignored) && !is_manifest(entry.path()) && entry.path().extension() != ".md" &&
        entry.file_size(ignored) <= kLargestProgram) {
      hashes.push_back(sha256_file(entry.path()));
    }
  }
  return hashes;
}

/// A method is another one when its manifest, its program or a file beside one of them is, such as the helper
/// that takes the times. Files of other methods in the folder count too: better measured once too often.
std::string hash_of(const std::string& text, const json& command, const fs::path& folder) {
  std::vector<std::string> hashes = program_hashes(folder);
  const std::vector<std::string> helpers = program_hashes(folder / ".." / "process");
  hashes.insert(hashes.end(), helpers.begin(), helpers.end());
  for (const json& word : command) {
    const fs::path file = resolved(word.get<std::string>(), folder);
    if (is_beside(word.get<std::string>()) && fs::is_regular_file(file)) hashes.push_back(sha256_file(file));
  }
  std::ranges::sort(hashes);
  std::string all = sha256_hex(text);
  for (const std::string& hash : hashes) all += hash;
  return sha256_hex(all);
}

}  // namespace

bool is_manifest(const fs::path& file) {
  const std::string name = file.filename().string();
  return file.extension() == ".json" && name != "package.json" && name != "package-lock.json";
}

Manifest load_manifest(const fs::path& file) {
  const std::string source = "the manifest " + file.string();
  const std::optional<std::string> text = read_text_file(file);
  if (!text) throw ConfigurationError("cannot read the manifest " + file.string());
  const json document = plan::parse_json(*text, source);
  if (const auto faults = record::validate_manifest(document); !faults.empty()) {
    throw ConfigurationError(source + " has a fault; mend or remove it: " + faults.front());
  }
  const fs::path folder = fs::absolute(file).parent_path();
  Manifest manifest;
  manifest.file = file;
  manifest.sha256 = hash_of(*text, document["command"], folder);
  manifest.method.info = info_of(document);
  manifest.method.name = manifest.method.info->name;
  manifest.method.title = manifest.method.info->title;
  manifest.method.command = resolved_words(document, "command", folder);
  manifest.method.needs = resolved_words(document, "needs", folder);
  manifest.method.install = document.value("install", "");
  manifest.method.sources = manifest.sha256.substr(0, 8);
  manifest.method.jit = document.value("jit", false);
  manifest.runs =
      plan::parse_plan_methods(document.value("runs", json::array()), manifest.method.name, source, "runs");
  return manifest;
}

std::vector<Manifest> load_manifests(const std::vector<fs::path>& folders) {
  std::vector<Manifest> manifests;
  for (const fs::path& folder : folders) {
    std::vector<fs::path> files;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
      if (is_manifest(entry.path())) files.push_back(entry.path());
    }
    std::ranges::sort(files);
    for (const fs::path& file : files) {
      Manifest manifest = load_manifest(file);
      const auto same = std::ranges::find_if(
          manifests, [&](const Manifest& other) { return other.method.name == manifest.method.name; });
      if (same != manifests.end() && same->sha256 == manifest.sha256) continue;
      if (same != manifests.end()) {
        throw ConfigurationError("two manifests describe the method '" + manifest.method.name +
                                 "': " + same->file.string() + " and " + file.string() + "; rename one");
      }
      manifests.push_back(std::move(manifest));
    }
  }
  return manifests;
}

}  // namespace hullbench::run
