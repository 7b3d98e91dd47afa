#include "benchmarks/run/workbench.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "benchmarks/record/kept_polygons.hpp"

namespace hullbench::run {

MethodRun::MethodRun(std::shared_ptr<const DrawnCase> drawn_case, const std::string& method,
                     Parameters parameters)
    : drawn(std::move(drawn_case)), record(drawn->record_of(method)) {
  record.parameters = std::move(parameters);
}

void MethodRun::begin(worker::MethodSession& its_session, const std::optional<MethodInfo>& info,
                      double timeout_s) {
  session = &its_session;
  timeout = std::chrono::milliseconds(std::max<std::int64_t>(1, std::llround(timeout_s * 1000)));
  if (info) record.method_version = info->version;
  if (!info) {
    fail(session->start_reply().status, session->start_failure());
  } else if (!drawn->missing().empty()) {
    fail(drawn->missing_status(), drawn->missing());
  } else if (!over) {
    try {
      record.parameters = complete_parameters(*info, record.parameters);
    } catch (const std::invalid_argument& error) {
      fail(record::Status::kError, error.what());
    }
  }
  record.id = record::run_identity(record);
}

void MethodRun::fail(record::Status status, const std::string& detail) {
  record.status = status;
  record.detail = detail;
  over = true;
}

void MethodRun::score() {
  if (result) drawn->score(record, *result, peak_memory_bytes, draws);
}

void MethodRun::score_l2() {
  if (result) drawn->score_l2(record, *result);
}

Workbench::Workbench(fs::path scratch) : scratch_(std::move(scratch)) {
  fs::create_directories(scratch_);
}

// One after the other they would take seconds: each interpreter, virtual machine and server its own time.
Workbench::~Workbench() {
  for (const auto& session : sessions_) session->begin_quit();
}

void Workbench::add(worker::Method method, const worker::WorkerLimits& limits) {
  sessions_.push_back(std::make_unique<worker::MethodSession>(std::move(method), limits));
}

worker::MethodSession* Workbench::find(const std::string& method) const {
  const auto found =
      std::ranges::find_if(sessions_, [&](const auto& session) { return session->method().name == method; });
  return found == sessions_.end() ? nullptr : found->get();
}

void Workbench::start(Progress& progress) {
  for (const auto& session : sessions_) session->begin_start();
  for (const auto& session : sessions_) {
    session->finish_start();
    if (session->info()) continue;
    progress.note("hullbench: " + session->method().name + " does not start (" +
                  to_string(session->start_reply().status) + "): " + session->start_failure());
  }
}

void Workbench::warm_up(MethodRun& run, WarmUpFor wanted) {
  const worker::LoadedPoints& points = points_of(run);
  const bool is_cold = wanted == WarmUpFor::kProcess ? run.session->is_cold()
                                                     : run.session->is_cold(points, run.record.parameters);
  if (!is_cold) return;
  const bool is_new = !run.session->has_run();
  const worker::Attempt first = run.session->warm_up(points, run.record.parameters, scratch_, run.timeout);
  if (first.status != record::Status::kOk) {
    run.fail(first.status, first.detail);
  } else if (is_new && !run.record.cold_time_ns) {
    run.record.cold_time_ns = first.time_ns();
  }
}

worker::Attempt Workbench::attempt(MethodRun& run, worker::Watch watch) {
  worker::Attempt attempt =
      run.session->run(points_of(run), run.record.parameters, scratch_, run.timeout, watch);
  run.peak_memory_bytes = std::max(run.peak_memory_bytes, attempt.peak_memory_bytes);
  if (attempt.status != record::Status::kOk) {
    run.fail(attempt.status, attempt.detail);
    return attempt;
  }
  const std::string hash = record::hash_of(attempt.wkb);
  if (run.record.output_sha256.empty()) {
    run.record.output_sha256 = hash;
    run.result = read_result(run.record, attempt.wkb);
    run.over = !run.result;
  } else if (run.record.output_sha256 != hash) {
    run.fail(record::Status::kInvalidOutput, "two runs on the same points gave different results");
  }
  return attempt;
}

const worker::LoadedPoints& Workbench::points_of(const MethodRun& run) {
  const PointSet& set = run.drawn->set();
  if (!points_ || points_->key != set.sha256)
    points_ = worker::write_points(set.sha256, set.points, scratch_);
  return *points_;
}

}  // namespace hullbench::run
