// The harness's side of the worker protocol: starts a worker with its limits, asks it, and survives whatever
// it does.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/record/record.hpp"

namespace hullbench::worker {

/// What a worker may use.
struct WorkerLimits {
  std::int64_t memory_mib = 0;  ///< address space (RLIMIT_AS); 0: no limit
  std::optional<int> core;      ///< the one processor core it runs on; none: any
  /// The longest file it may write: the largest result that is read, and a database's usual segment.
  std::int64_t file_mib = 1024;
};

/// A worker's answer to one request, or what happened instead.
struct Reply {
  record::Status status = record::Status::kOk;
  std::string detail;                   ///< one sentence or a signal's name; empty when ok
  std::string remedy;                   ///< the command that helps; only with kNotInstalled
  json body;                            ///< the reply; an empty object when not ok
  std::chrono::nanoseconds elapsed{0};  ///< from request to reply, as seen from outside
};

/// A running worker process, in a session of its own, that ends with this object or with the harness,
/// whichever is first. It has the harness's environment, with huge pages asked for (huge_pages.hpp). What it
/// started ends with it, in whatever session (see stray_processes.hpp). The limits hold for each of its
/// processes by itself.
///
/// Status of a reply: `timeout` when it does not come in time (the worker is killed), `crash` when the worker
/// ends without answering (detail: the signal's name or the exit code), `memory` when it ends or says so for
/// lack of memory, `error`, `unsupported`, `not_installed` as the worker says, and `error` when it answers
/// something else than the protocol (the worker is killed). After every status but ok, `alive` tells whether
/// the worker can be asked again.
class WorkerProcess {
 public:
  /// Starts `command` (program and arguments). Throws std::system_error when it cannot be started.
  WorkerProcess(const std::vector<std::string>& command, const WorkerLimits& limits);
  /// Kills it if it still runs.
  ~WorkerProcess();
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;

  /// Sends a request; its reply must be received before the next one is sent.
  void send(const json& request);
  /// Waits for the reply, at most until `timeout` after the request was sent. Throws Interrupted on Ctrl-C,
  /// with the worker killed, and when the worker was ended by a signal that ends the harness too.
  Reply receive(std::chrono::milliseconds timeout);
  /// Both.
  Reply request(const json& request, std::chrono::milliseconds timeout);

  /// Whether the process runs and can be asked.
  bool alive() const { return pid_ > 0; }
  pid_t pid() const { return pid_; }

  /// Lets the process's peak of resident memory begin anew at what it holds now. False when it is not running
  /// or the system does not allow it.
  bool reset_peak_memory() const;
  /// Largest resident size of the process since then, in bytes, without the processes that it started; none
  /// when the system does not tell.
  std::optional<std::int64_t> peak_memory_bytes() const;

  /// Asks it to end, without waiting, so that several can end at the same time.
  void ask_to_quit();
  /// Asks it to end, waits at most `patience` and kills it then. Whether it ended by itself.
  bool quit(std::chrono::milliseconds patience);
  /// Ends it and every process of its session's group: SIGTERM, and SIGKILL after a short grace.
  void kill();

 private:
  struct Ending {
    int wait_status = 0;
    std::int64_t peak_kib = 0;  ///< largest resident size
  };

  Reply wait_for_line(std::chrono::steady_clock::time_point deadline, std::chrono::milliseconds timeout);
  Reply parse_line(const std::string& line);
  bool has_complete_line() const { return output_.find('\n') != std::string::npos; }
  /// Reads what there is, at most for `patience`; false at the end of the output.
  bool read_pipes(std::chrono::milliseconds patience);
  void drain_errors();
  /// Whether the process has ended; it stays to be reaped.
  bool ended() const;
  /// Waits for the end and takes the rest of the group with it.
  Ending reap();
  std::optional<Ending> reap_within(std::chrono::milliseconds patience);
  Reply reply_for_ending(const Ending& ending) const;
  Reply broken_protocol(const std::string& what);
  Reply lost_output();
  void close_pipes();

  std::string mark_;  ///< of it and its children
  pid_t pid_ = -1;
  int input_ = -1;    ///< the worker's standard input, written by us
  int replies_ = -1;  ///< its standard output
  int errors_ = -1;   ///< its standard error
  std::int64_t memory_mib_ = 0;
  std::string output_;      ///< received and not yet taken, at most a line and a bit
  std::string last_words_;  ///< the end of what it wrote to standard error
  bool unasked_ = false;    ///< it spoke before it was asked
  std::chrono::steady_clock::time_point sent_;
};

}  // namespace hullbench::worker
