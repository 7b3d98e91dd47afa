#include "benchmarks/tune/evaluation.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/tune/search.hpp"
#include "benchmarks/worker/protocol.hpp"
#include "datasets/sha256.hpp"

namespace hullbench::tune {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

bool is_sweep_file(const fs::path& file) {
  return file.extension() == ".jsonl" && file.filename().string().starts_with("sweep");
}

/// The file's descriptor with the lock on it, which goes with the descriptor.
int lock_file(const fs::path& file) {
  const int lock = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (lock < 0) {
    throw ConfigurationError("cannot write " + file.string() + " (" + std::generic_category().message(errno) +
                             "); choose another folder with --out");
  }
  // A file system without locks is no reason to refuse.
  if (::flock(lock, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return lock;
  ::close(lock);
  throw ConfigurationError("another 'hullbench tune' is writing to " + file.string() +
                           "; wait for it, or choose another folder with --out");
}

}  // namespace

double Evaluation::error() const {
  return l2.value_or(kInfinitelyBad);
}

std::string evaluation_identity(const Evaluation& evaluation) {
  const json identity = {{"method", evaluation.method},
                         {"method_version", evaluation.method_version},
                         {"program", evaluation.program},
                         {"dataset", evaluation.dataset},
                         {"dataset_sha256", evaluation.dataset_sha256},
                         {"holes", evaluation.holes},
                         {"parameters", worker::parameters_to_json(evaluation.parameters)}};
  return sha256_hex(identity.dump(-1, ' ', false, json::error_handler_t::replace));
}

json evaluation_to_json(const Evaluation& evaluation) {
  return {{"kind", "evaluation"},
          {"schema_version", record::kSchemaVersion},
          {"id", evaluation.id},
          {"case", evaluation.case_name},
          {"method", evaluation.method},
          {"method_version", evaluation.method_version},
          {"program", evaluation.program},
          {"dataset", evaluation.dataset},
          {"dataset_sha256", evaluation.dataset_sha256},
          {"n", evaluation.n},
          {"holes", evaluation.holes},
          {"seed", evaluation.seed},
          {"parameters", worker::parameters_to_json(evaluation.parameters)},
          {"status", to_string(evaluation.status)},
          {"detail", evaluation.detail},
          {"l2", evaluation.l2 ? json(*evaluation.l2) : json(nullptr)}};
}

Evaluation evaluation_from_json(const json& source) {
  Evaluation result;
  source.at("id").get_to(result.id);
  source.at("case").get_to(result.case_name);
  source.at("method").get_to(result.method);
  source.at("method_version").get_to(result.method_version);
  source.at("program").get_to(result.program);
  source.at("dataset").get_to(result.dataset);
  source.at("dataset_sha256").get_to(result.dataset_sha256);
  source.at("n").get_to(result.n);
  source.at("holes").get_to(result.holes);
  source.at("seed").get_to(result.seed);
  result.parameters = worker::parameters_from_json(source.at("parameters"));
  result.status = record::status_from_string(source.at("status").get<std::string>());
  source.at("detail").get_to(result.detail);
  if (!source.at("l2").is_null()) result.l2 = source.at("l2").get<double>();
  return result;
}

EvaluationStore::EvaluationStore(const fs::path& folder, const std::string& file)
    : lock_(lock_file(folder / file)) {
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
}

EvaluationStore::~EvaluationStore() {
  ::close(lock_);
}

std::optional<Evaluation> EvaluationStore::find(const std::string& id) const {
  const std::scoped_lock guard(mutex_);
  const auto found = known_.find(id);
  return found == known_.end() ? std::nullopt : std::optional(found->second);
}

std::vector<Evaluation> EvaluationStore::all() const {
  const std::scoped_lock guard(mutex_);
  std::vector<Evaluation> result;
  result.reserve(known_.size());
  for (const auto& [id, evaluation] : known_) result.push_back(evaluation);
  return result;
}

void EvaluationStore::append(const Evaluation& evaluation) {
  const std::scoped_lock guard(mutex_);
  writer_->append(evaluation_to_json(evaluation));
  known_.emplace(evaluation.id, evaluation);
}

}  // namespace hullbench::tune
