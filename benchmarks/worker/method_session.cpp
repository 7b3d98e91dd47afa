#include "benchmarks/worker/method_session.hpp"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "benchmarks/record/record.hpp"
#include "benchmarks/worker/protocol.hpp"

namespace hullbench::worker {
namespace {

using namespace std::chrono_literals;

/// For a worker that is asked to end: it may have a database server to stop.
constexpr auto kQuitPatience = 10s;

Attempt failed(record::Status status, std::string detail, std::chrono::nanoseconds elapsed = 0ns) {
  Attempt attempt;
  attempt.status = status;
  attempt.detail = std::move(detail);
  attempt.elapsed = elapsed;
  return attempt;
}

Reply failed_start(record::Status status, std::string detail, std::string remedy = "") {
  Reply reply;
  reply.remedy = std::move(remedy);
  reply.status = status;
  reply.detail = std::move(detail);
  return reply;
}

/// Of a request to a method that has started: what it lacks by then, such as a server that went down, is an
/// error of this run, not a method that is not installed.
Reply after_start(Reply reply) {
  if (reply.status == record::Status::kNotInstalled) reply.status = record::Status::kError;
  return reply;
}

/// A disk that is full is nobody's failure: the run ends, and can go on once there is room.
void check_room(const fs::path& scratch) {
  constexpr std::uintmax_t kLeast = std::uintmax_t{1} << 20;
  std::error_code unknown;
  const fs::space_info space = fs::space(scratch, unknown);
  if (!unknown && space.available < kLeast)
    throw std::runtime_error("the disk of " + scratch.string() + " is full; make room and start again");
}

/// The phases in a reply; throws std::invalid_argument when they are not what the protocol says.
record::PhaseTimes read_phases(const json& body, std::initializer_list<const char*> required) {
  const auto found = body.find("phases_ns");
  if (found == body.end() || !found->is_object()) throw std::invalid_argument("the reply has no phases_ns");
  record::PhaseTimes phases;
  for (const auto& [name, value] : found->items()) {
    if (!value.is_number_integer() || value.get<std::int64_t>() < 0) {
      throw std::invalid_argument("the phase '" + printable(name, 40) + "' is not a time in nanoseconds");
    }
    phases[name] = value.get<std::int64_t>();
  }
  for (const char* name : required) {
    if (!phases.contains(name))
      throw std::invalid_argument("the reply has no phase '" + std::string(name) + "'");
  }
  return phases;
}

/// Whether the last runs are hardly faster than those before them.
bool is_warm(const std::vector<std::int64_t>& times, const WarmUp& wanted) {
  if (times.size() < std::max(wanted.runs, 2 * wanted.steady)) return false;
  const auto steady = static_cast<std::ptrdiff_t>(wanted.steady);
  const auto last = times.end() - steady;
  const auto best = static_cast<double>(*std::min_element(last, times.end()));
  const auto best_before = static_cast<double>(*std::min_element(last - steady, last));
  return best >= (1 - kSteadyGain) * best_before;
}

/// Which points a method was warmed up for, and with which parameters.
std::string warm_up_key(const LoadedPoints& points, const Parameters& parameters) {
  return points.key + " " + record::parameters_to_json(parameters).dump();
}

}  // namespace

std::int64_t Attempt::time_ns() const {
  return phases_ns.at("run") + phases_ns.at("extract");
}

MethodSession::MethodSession(Method method, const WorkerLimits& limits)
    : method_(std::move(method)), limits_(limits) {
  start_reply_ = failed_start(record::Status::kError, "the worker was not started");
}

MethodSession::~MethodSession() {
  quit(kQuitPatience);
}

std::string MethodSession::start_failure() const {
  return start_reply_.remedy.empty() ? start_reply_.detail
                                     : start_reply_.detail + "; remedy: " + start_reply_.remedy;
}

void MethodSession::begin_quit() {
  if (worker_) worker_->ask_to_quit();
}

bool MethodSession::quit(std::chrono::milliseconds patience) {
  const bool ended = !worker_ || worker_->quit(patience);
  worker_.reset();
  return ended;
}

void MethodSession::begin_start() {
  loaded_key_.clear();
  warmed_up_for_.clear();
  runs_of_process_ = 0;
  worker_.reset();
  for (const std::string& file : method_.needs) {
    if (fs::exists(file)) continue;
    start_reply_ = failed_start(record::Status::kNotInstalled, "there is no " + file, method_.install);
    return;
  }
  try {
    worker_ = std::make_unique<WorkerProcess>(method_.command, limits_);
  } catch (const std::system_error& error) {
    // The program of a manifest is part of what is to be installed.
    const bool missing = method_.info && error.code() == std::errc::no_such_file_or_directory;
    start_reply_ = missing ? failed_start(record::Status::kNotInstalled,
                                          "there is no program " + method_.command.front(), method_.install)
                           : failed_start(record::Status::kError, error.what());
    return;
  }
  worker_->send({{"request", "hello"}, {"protocol", kProtocolVersion}});
}

void MethodSession::finish_start() {
  info_.reset();
  if (!worker_) return;
  start_reply_ = worker_->receive(kStartTimeout);
  if (start_reply_.status == record::Status::kOk) {
    try {
      if (start_reply_.body.at("protocol") != kProtocolVersion) {
        throw std::invalid_argument("it speaks another version of the protocol");
      }
      if (method_.info) {
        info_ = method_.info;
        start_reply_.body.at("version").get_to(info_->version);
      } else {
        info_ = method_from_json(start_reply_.body.at("method"));
      }
      if (info_->name != method_.name)
        throw std::invalid_argument("it calls itself '" + printable(info_->name, 40) + "'");
      if (info_->version.empty()) throw std::invalid_argument("it does not tell its version");
      // An adapter or a core that was changed is another method, though its library has the same version.
      if (!method_.sources.empty()) info_->version += "+" + method_.sources;
    } catch (const std::exception& error) {
      info_.reset();
      start_reply_ =
          failed_start(record::Status::kError,
                       "the worker broke the protocol in its first answer: " + printable(error.what(), 200));
    }
  }
  if (start_reply_.status == record::Status::kNotInstalled && start_reply_.remedy.empty()) {
    start_reply_.remedy = method_.install;
  }
  if (!info_) worker_.reset();
}

Reply MethodSession::load(const LoadedPoints& points, std::chrono::milliseconds timeout) {
  loaded_key_.clear();
  Reply reply = after_start(
      worker_->request({{"request", "load"}, {"points", points.file.string()}, {"n", points.n}}, timeout));
  if (reply.status != record::Status::kOk) return reply;
  try {
    load_phases_ = read_phases(reply.body, {"load"});
    loaded_key_ = points.key;
  } catch (const std::invalid_argument& error) {
    reply.status = record::Status::kError;
    reply.detail = std::string("the worker broke the protocol: ") + error.what();
  }
  return reply;
}

Attempt MethodSession::run(const LoadedPoints& points, const Parameters& parameters, const fs::path& scratch,
                           std::chrono::milliseconds timeout, Watch watch) {
  if (!worker_ || !worker_->alive()) {
    begin_start();
    finish_start();
  }
  if (!info_) return failed(start_reply_.status, start_reply_.detail);
  if (loaded_key_ != points.key) {
    const Reply loaded = load(points, timeout);
    if (loaded.status != record::Status::kOk)
      return failed(loaded.status, "on loading the points: " + loaded.detail);
  }
  // A name of its own for every run: what an earlier run left can never be taken for this one's result.
  const std::string nonce =
      method_.name + "-" + std::to_string(worker_->pid()) + "-" + std::to_string(++run_count_);
  fs::create_directories(scratch);  // a method may have removed it
  const fs::path result = scratch / ("result-" + nonce + ".wkb");
  const bool watches_memory =
      watch == Watch::kMemory && !info_->capabilities.in_server && worker_->reset_peak_memory();
  ++runs_of_process_;
  const Reply reply = after_start(worker_->request({{"request", "run"},
                                                    {"nonce", nonce},
                                                    {"parameters", record::parameters_to_json(parameters)},
                                                    {"result", result.string()}},
                                                   timeout));
  Attempt attempt = reply.status == record::Status::kOk ? read_result(reply, nonce, result)
                                                        : failed(reply.status, reply.detail, reply.elapsed);
  if (watches_memory) attempt.peak_memory_bytes = worker_->peak_memory_bytes();
  // Whatever failed may have lost the points too, such as the connection to a server.
  if (attempt.status != record::Status::kOk) {
    loaded_key_.clear();
    check_room(scratch);
  }
  // After a lack of memory, or an answer that is none, nobody knows what is left undone in the worker.
  if (attempt.status == record::Status::kMemory || attempt.status == record::Status::kInvalidOutput)
    worker_.reset();
  std::error_code ignored;
  fs::remove(result, ignored);
  return attempt;
}

bool MethodSession::is_cold(const LoadedPoints& points, const Parameters& parameters) const {
  return is_cold() || (method_.jit && !warmed_up_for_.contains(warm_up_key(points, parameters)));
}

Attempt MethodSession::warm_up(const LoadedPoints& points, const Parameters& parameters,
                               const fs::path& scratch, std::chrono::milliseconds timeout) {
  const WarmUp wanted = is_cold() ? kWarmUpOfProcess : kWarmUpOfCase;
  const auto end = std::chrono::steady_clock::now() + wanted.time;
  Attempt first = run(points, parameters, scratch, timeout);
  if (first.status != record::Status::kOk) return first;
  std::vector<std::int64_t> times = {first.time_ns()};
  while (!is_warm(times, wanted) && std::chrono::steady_clock::now() < end) {
    Attempt next = run(points, parameters, scratch, timeout);
    if (next.status != record::Status::kOk) return next;
    times.push_back(next.time_ns());
  }
  warmed_up_for_.insert(warm_up_key(points, parameters));
  return first;
}

Attempt MethodSession::read_result(const Reply& reply, const std::string& nonce, const fs::path& result) {
  Attempt attempt;
  attempt.elapsed = reply.elapsed;
  try {
    const auto said = reply.body.find("nonce");
    if (said == reply.body.end() || *said != nonce) {
      throw std::invalid_argument("the reply is to another run than the one that was asked for");
    }
    attempt.phases_ns = read_phases(reply.body, {"run", "extract"});
    if (attempt.phases_ns["run"] > attempt.elapsed.count() ||
        attempt.phases_ns["extract"] > attempt.elapsed.count() - attempt.phases_ns["run"]) {
      throw std::invalid_argument("it reports more time than has passed");
    }
    attempt.phases_ns["outside"] = attempt.elapsed.count();
    attempt.wkb = read_bytes(result, kMaxResultBytes);
  } catch (const std::exception& error) {
    return failed(record::Status::kInvalidOutput, printable(error.what(), 300), reply.elapsed);
  }
  for (const auto& [name, time] : load_phases_) attempt.phases_ns[name] = time;
  return attempt;
}

LoadedPoints write_points(std::string key, std::span<const Point> points, const fs::path& folder) {
  LoadedPoints result = {std::move(key), folder / "points.f64", points.size()};
  write_points_file(result.file, points);
  return result;
}

json describe_method(const MethodSession& session) {
  MethodInfo info;
  if (session.method().info) info = *session.method().info;
  if (session.info()) info = *session.info();
  info.name = session.method().name;
  info.title = session.method().title;
  json result = method_to_json(info);
  result["installed"] = session.info().has_value();
  result["detail"] = session.info() ? "" : session.start_reply().detail;
  result["remedy"] = session.info() ? "" : session.start_reply().remedy;
  return result;
}

}  // namespace hullbench::worker
