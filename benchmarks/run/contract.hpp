// The contract of a method, tried on its worker: what every method must do whatever its algorithm is.
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "benchmarks/worker/method_session.hpp"

namespace hullbench::run {

/// One point of the contract.
struct Verdict {
  std::string name;                             ///< "three points"
  bool kept = false;                            ///< whether the method does what it must
  record::Status status = record::Status::kOk;  ///< of the run that decided it
  std::string words;                            ///< what was seen, and when it was not kept what to mend
};

/// How far a method is tried.
struct ContractLimits {
  worker::WorkerLimits worker;
  std::chrono::milliseconds timeout;  ///< for one run
  std::size_t many_points = 20'000;  ///< of the largest set; by default as many as a plan's larger cases have
};

/// Runs the whole contract on a worker of its own and hands every verdict to `say` as it comes. Files go into
/// `scratch`. Stops after a worker that does not start and after the
/// second run that takes too long. Returns the verdicts.
/// Throws Interrupted, and std::runtime_error when a file cannot be written.
std::vector<Verdict> test_contract(const worker::Method& method, const ContractLimits& limits,
                                   const fs::path& scratch, const std::function<void(const Verdict&)>& say);

}  // namespace hullbench::run
