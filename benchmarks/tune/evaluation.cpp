#include "benchmarks/tune/evaluation.hpp"

#include <unistd.h>

#include <array>
#include <exception>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "benchmarks/base/files.hpp"
#include "benchmarks/run/run_directory.hpp"
#include "benchmarks/tune/search.hpp"
#include "datasets/sha256.hpp"

namespace hullbench::tune {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// What a line has of a run's record.
constexpr std::array kSharedMembers = {"schema_version", "id",    "method", "method_version", "dataset",
                                       "dataset_sha256", "n",     "holes",  "seed",           "parameters",
                                       "status",         "detail"};

bool is_sweep_file(const fs::path& file) {
  return file.extension() == ".jsonl" && file.filename().string().starts_with("sweep");
}

}  // namespace

double error_of(const Evaluation& evaluation) {
  return evaluation.metrics.value("l2", kInfinitelyBad);
}

std::string evaluation_identity(const Evaluation& evaluation) {
  json identity = evaluation_to_json(evaluation);
  for (const char* key : {"kind", "schema_version", "id", "case", "n", "seed", "status", "detail", "l2"})
    identity.erase(key);
  return sha256_hex(dump_text(identity, -1));
}

json evaluation_to_json(const Evaluation& evaluation) {
  json line = {{"kind", "evaluation"},
               {"case", evaluation.name},
               {"program", evaluation.program},
               {"l2", evaluation.metrics.value("l2", json())}};
  const json record = evaluation;
  for (const char* key : kSharedMembers) line[key] = record.at(key);
  return line;
}

Evaluation evaluation_from_json(const json& line) {
  json record = {{"name", line.at("case")},   {"protocol", ""},
                 {"time_ns", json::array()},  {"phases_ns", json::array()},
                 {"metrics", json::object()}, {"output_sha256", ""}};
  for (const char* key : kSharedMembers) record[key] = line.at(key);
  if (!line.at("l2").is_null()) record["metrics"]["l2"] = line["l2"].get<double>();
  auto evaluation = record.get<Evaluation>();
  line.at("program").get_to(evaluation.program);
  return evaluation;
}

EvaluationStore::EvaluationStore(const fs::path& folder, const std::string& file)
    : lock_(run::lock_or_throw(folder / file)), scratch_(fs::absolute(folder / ("scratch-" + file))) {
  writer_.emplace(folder / file);
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (!is_sweep_file(entry.path())) continue;
    for (const json& line : record::load_json_lines(entry.path()).lines) {
      try {
        Evaluation evaluation = evaluation_from_json(line);
        known_.emplace(evaluation.id, std::move(evaluation));
      } catch (const std::exception& error) {
        throw std::runtime_error(entry.path().string() + " has a line that is no evaluation (" +
                                 error.what() + "); move the file away");
      }
    }
  }
  found_ = known_.size();
  fs::remove_all(scratch_);
  fs::create_directory(scratch_);
}

EvaluationStore::~EvaluationStore() {
  std::error_code ignored;
  fs::remove_all(scratch_, ignored);
  ::close(lock_);
}

const Evaluation* EvaluationStore::find(const std::string& id) const {
  const std::scoped_lock guard(mutex_);
  const auto found = known_.find(id);
  return found == known_.end() ? nullptr : &found->second;
}

void EvaluationStore::append(const Evaluation& evaluation) {
  const std::scoped_lock guard(mutex_);
  writer_->append(evaluation_to_json(evaluation));
  known_.emplace(evaluation.id, evaluation);
}

}  // namespace hullbench::tune
