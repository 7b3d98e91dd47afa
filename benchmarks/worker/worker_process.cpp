#include "benchmarks/worker/worker_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <string_view>
#include <system_error>
#include <thread>

#include "benchmarks/base/huge_pages.hpp"
#include "benchmarks/base/interrupt.hpp"
#include "benchmarks/worker/protocol.hpp"
#include "benchmarks/worker/stray_processes.hpp"

namespace hullbench::worker {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// How often a wait looks at the Ctrl-C flag and at whether the worker lives.
constexpr auto kTick = 50ms;
/// Between SIGTERM and SIGKILL: enough for a method to stop a server that it started.
constexpr auto kTermGrace = 1000ms;
/// Between the arrivals of one signal that is sent to all processes of a job.
constexpr auto kJobSignalSpread = 500ms;
constexpr rlim_t kMib = rlim_t{1024} * 1024;
constexpr std::size_t kLastWordsBytes = 4096;
/// Of the last words, what goes into a record.
constexpr std::size_t kDetailCharacters = 300;
/// A worker that died with this share of its memory limit in use is taken to have died of it.
constexpr double kMemoryShare = 0.9;

void close_fd(int& fd) {
  if (fd >= 0) ::close(fd);
  fd = -1;
}

/// Closes the ends that nobody has taken.
struct Pipe {
  Pipe() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
      throw std::system_error(errno, std::generic_category(), "cannot make a pipe");
    read_end = ends[0];
    write_end = ends[1];
  }
  ~Pipe() {
    close_fd(read_end);
    close_fd(write_end);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int read_end = -1;
  int write_end = -1;
};

/// `strings` as exec wants them, which keeps them unchanged.
std::vector<char*> pointers_to(const std::vector<std::string>& strings) {
  std::vector<char*> result;
  result.reserve(strings.size() + 1);
  for (const std::string& string : strings) result.push_back(const_cast<char*>(string.c_str()));
  result.push_back(nullptr);
  return result;
}

/// Our environment with `mark` in it and with huge pages asked for.
std::vector<std::string> worker_environment(const std::string& mark) {
  const std::string marking = std::string(kMarkVariable) + "=";
  const std::string tuning = std::string(kTunablesVariable) + "=";
  std::string_view own_tunables;
  std::vector<std::string> result = {marking + mark};
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view variable = *entry;
    if (variable.starts_with(tuning)) {
      own_tunables = variable.substr(tuning.size());
    } else if (!variable.starts_with(marking)) {
      result.emplace_back(variable);
    }
  }
  result.push_back(tuning + worker_tunables(own_tunables));
  return result;
}

/// Sets a limit to `mib`, or leaves it where the harness itself has a lower one. Returns errno when it fails.
int lower_limit(__rlimit_resource what, std::int64_t mib) {
  rlimit limit = {};
  if (::getrlimit(what, &limit) != 0) return errno;
  limit.rlim_max = std::min(limit.rlim_max, static_cast<rlim_t>(mib) * kMib);
  limit.rlim_cur = std::min(limit.rlim_cur, limit.rlim_max);
  return ::setrlimit(what, &limit) == 0 ? 0 : errno;
}

/// Everything the child does between fork and exec; only calls that are safe there. Returns errno when it
/// fails.
int become_worker(char* const* argv, char* const* environment, const WorkerLimits& limits, pid_t parent,
                  const Pipe& input, const Pipe& output, const Pipe& errors) {
  ::setsid();
  if (::prctl(PR_SET_PDEATHSIG, SIGKILL) != 0) return errno;
  // The harness may have died before the line above took effect.
  if (::getppid() != parent) ::_exit(127);

  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
    if (::signal(signal, SIG_DFL) == SIG_ERR) return errno;
  }

  const rlimit no_core = {0, 0};
  if (::setrlimit(RLIMIT_CORE, &no_core) != 0) return errno;
  if (const int error = lower_limit(RLIMIT_FSIZE, limits.file_mib)) return error;
  if (limits.memory_mib > 0) {
    if (const int error = lower_limit(RLIMIT_AS, limits.memory_mib)) return error;
  }
  if (limits.core) {
    cpu_set_t cores;
    CPU_ZERO(&cores);
    CPU_SET(static_cast<std::size_t>(*limits.core), &cores);
    if (::sched_setaffinity(0, sizeof cores, &cores) != 0) return errno;
  }
  if (::dup2(input.read_end, STDIN_FILENO) < 0 || ::dup2(output.write_end, STDOUT_FILENO) < 0 ||
      ::dup2(errors.write_end, STDERR_FILENO) < 0) {
    return errno;
  }
  // Files that libraries of the harness have open without the flag; an old kernel's refusal does no harm.
  ::close_range(STDERR_FILENO + 1, ~0U, CLOSE_RANGE_CLOEXEC);
  ::execvpe(argv[0], argv, environment);
  return errno;
}

/// Writes without the signal that a closed pipe raises, and without touching how the program as a whole
/// handles it.
bool write_all(int fd, std::string_view bytes) {
  sigset_t broken_pipe;
  sigset_t before;
  sigemptyset(&broken_pipe);
  sigaddset(&broken_pipe, SIGPIPE);
  pthread_sigmask(SIG_BLOCK, &broken_pipe, &before);
  bool complete = true;
  while (!bytes.empty()) {
    const ssize_t count = ::write(fd, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      complete = false;
      const timespec no_wait = {0, 0};
      if (errno == EPIPE) sigtimedwait(&broken_pipe, nullptr, &no_wait);
      break;
    }
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return complete;
}

/// "SIGSEGV" for 11.
std::string signal_name(int signal) {
  const char* name = ::sigabbrev_np(signal);
  return name ? "SIG" + std::string(name) : "signal " + std::to_string(signal);
}

/// A signal that ends a whole job (a time limit, a shutdown) reaches the worker and the harness, in any
/// order: then it is an interruption and no crash of the method. Throws Interrupted.
void throw_if_ended_with_us(int signal) {
  if (signal != SIGTERM && signal != SIGINT && signal != SIGHUP && signal != SIGKILL) return;
  const auto deadline = Clock::now() + kJobSignalSpread;
  while (!interrupted() && Clock::now() < deadline) std::this_thread::sleep_for(10ms);
  throw_if_interrupted();
}

Reply failure(record::Status status, std::string detail) {
  Reply reply;
  reply.status = status;
  reply.detail = std::move(detail);
  reply.body = json::object();
  return reply;
}

record::Status status_of_kind(const std::string& kind) {
  if (kind == "memory") return record::Status::kMemory;
  if (kind == "unsupported") return record::Status::kUnsupported;
  if (kind == "not_installed") return record::Status::kNotInstalled;
  return record::Status::kError;
}

bool speaks_of_memory(const std::string& words) {
  // The last one is the loader's, when not even the program's libraries fit.
  for (const char* sign :
       {"bad_alloc", "out of memory", "Out of memory", "Cannot allocate memory", "insufficient memory",
        "Could not reserve enough space", "process OOM", "heap out of memory", "MemoryError",
        "memory allocation of", "failed to map segment from shared object"}) {
    if (words.find(sign) != std::string::npos) return true;
  }
  return false;
}

}  // namespace

WorkerProcess::WorkerProcess(const std::vector<std::string>& command, const WorkerLimits& limits)
    : mark_(new_worker_mark()), memory_mib_(limits.memory_mib) {
  const std::vector<std::string> environment = worker_environment(mark_);
  const std::vector<char*> argv = pointers_to(command);
  const std::vector<char*> variables = pointers_to(environment);

  Pipe input;
  Pipe output;
  Pipe errors;
  Pipe start;  // carries errno when the program does not start; exec closes it
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child == 0) {
    const int error = become_worker(argv.data(), variables.data(), limits, parent, input, output, errors);
    if (::write(start.write_end, &error, sizeof error) < 0) ::_exit(126);
    ::_exit(127);
  }
  const int fork_error = errno;
  for (int* fd : {&input.read_end, &output.write_end, &errors.write_end, &start.write_end}) close_fd(*fd);
  pid_ = child;
  input_ = std::exchange(input.write_end, -1);
  replies_ = std::exchange(output.read_end, -1);
  errors_ = std::exchange(errors.read_end, -1);

  int error = child < 0 ? fork_error : 0;
  if (child > 0) {
    ssize_t got = 0;
    do got = ::read(start.read_end, &error, sizeof error);
    while (got < 0 && errno == EINTR);
    if (got <= 0) error = 0;
  }
  if (error != 0) {
    if (child > 0) reap();
    close_pipes();
    throw std::system_error(error, std::generic_category(), "cannot start the worker " + command.front());
  }
  for (const int fd : {replies_, errors_}) ::fcntl(fd, F_SETFL, ::fcntl(fd, F_GETFL) | O_NONBLOCK);
}

WorkerProcess::~WorkerProcess() {
  kill();
}

void WorkerProcess::send(const json& request) {
  if (alive()) {
    read_pipes(0ms);
    unasked_ = !output_.empty();
  }
  // Before the worker can know of the request: what it times must lie within what is timed here.
  sent_ = Clock::now();
  // A worker that is gone is noticed when its reply is received.
  if (alive()) write_all(input_, request.dump() + "\n");
}

Reply WorkerProcess::receive(std::chrono::milliseconds timeout) {
  if (!alive()) return failure(record::Status::kCrash, "the worker is not running");
  if (unasked_) return broken_protocol("spoke without being asked");
  Reply reply = wait_for_line(sent_ + timeout, timeout);
  reply.elapsed = Clock::now() - sent_;
  return reply;
}

Reply WorkerProcess::request(const json& request, std::chrono::milliseconds timeout) {
  send(request);
  return receive(timeout);
}

Reply WorkerProcess::wait_for_line(Clock::time_point deadline, std::chrono::milliseconds timeout) {
  while (!has_complete_line()) {
    if (output_.size() > kMaxLineBytes) return broken_protocol("sent a line of more than 1 MiB");
    if (interrupted()) {
      kill();
      throw Interrupted();
    }
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now());
    if (left <= 0ms) {
      kill();
      return failure(record::Status::kTimeout, "no answer within " + std::to_string(timeout.count() / 1000) +
                                                   "." + std::to_string(timeout.count() % 1000 / 100) + " s");
    }
    if (!read_pipes(std::min(left, std::chrono::milliseconds(kTick)))) return lost_output();
    if (!has_complete_line() && ended()) {
      for (std::size_t before = 0; output_.size() > before && output_.size() <= kMaxLineBytes;) {
        before = output_.size();
        read_pipes(0ms);
      }
      if (!has_complete_line()) return reply_for_ending(reap());
    }
  }
  const std::size_t end = output_.find('\n');
  const std::string line = output_.substr(0, end);
  output_.erase(0, end + 1);
  if (line.size() >= kMaxLineBytes) return broken_protocol("sent a line of more than 1 MiB");
  return parse_line(line);
}

Reply WorkerProcess::parse_line(const std::string& line) {
  const json message = json::parse(line, nullptr, false);
  if (!message.is_object()) return broken_protocol("answered '" + printable(line.substr(0, 60), 60) + "'");
  Reply reply;
  reply.body = message;
  if (!message.contains("error")) return reply;

  const json& error = message["error"];
  const auto text = [&](const char* key) {
    const auto found = error.is_object() ? error.find(key) : error.end();
    return error.is_object() && found != error.end() && found->is_string() ? found->get<std::string>() : "";
  };
  if (text("kind").empty()) return broken_protocol("answered with an error that has no kind");
  reply = failure(status_of_kind(text("kind")), printable(text("message"), kDetailCharacters));
  if (reply.detail.empty()) reply.detail = "the method gave no reason";
  reply.remedy = printable(text("remedy"), kDetailCharacters);
  return reply;
}

bool WorkerProcess::read_pipes(std::chrono::milliseconds patience) {
  std::array<pollfd, 2> watched = {{{replies_, POLLIN, 0}, {errors_, POLLIN, 0}}};
  // A worker that has closed its standard error would wake this wait for nothing again and again.
  const nfds_t count = errors_ >= 0 ? 2 : 1;
  if (::poll(watched.data(), count, static_cast<int>(patience.count())) <= 0) return true;
  drain_errors();
  if (watched[0].revents == 0) return true;
  std::array<char, 65536> chunk;
  const ssize_t got = ::read(replies_, chunk.data(), chunk.size());
  if (got > 0) output_.append(chunk.data(), static_cast<std::size_t>(got));
  return got > 0 || (got < 0 && (errno == EAGAIN || errno == EINTR));
}

void WorkerProcess::drain_errors() {
  std::array<char, 4096> chunk;
  // Bounded, so that a worker that floods its standard error cannot keep the harness here.
  for (int round = 0; round < 64 && errors_ >= 0; ++round) {
    const ssize_t got = ::read(errors_, chunk.data(), chunk.size());
    if (got == 0) close_fd(errors_);
    if (got <= 0) return;
    last_words_.append(chunk.data(), static_cast<std::size_t>(got));
    if (last_words_.size() > kLastWordsBytes) last_words_.erase(0, last_words_.size() - kLastWordsBytes);
  }
}

bool WorkerProcess::ended() const {
  siginfo_t info{};
  return ::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         info.si_pid == pid_;
}

WorkerProcess::Ending WorkerProcess::reap() {
  siginfo_t info{};
  while (::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOWAIT) != 0 && errno == EINTR) {
  }
  // Whatever the worker started and left behind in its group goes with it; before wait4, which frees the
  // number for other processes.
  ::kill(-pid_, SIGKILL);
  Ending ending;
  rusage usage{};
  while (::wait4(pid_, &ending.wait_status, 0, &usage) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  ending.peak_kib = usage.ru_maxrss;
  end_strays(mark_);
  drain_errors();
  close_pipes();
  return ending;
}

std::optional<WorkerProcess::Ending> WorkerProcess::reap_within(std::chrono::milliseconds patience) {
  const auto deadline = Clock::now() + patience;
  while (true) {
    if (ended()) return reap();
    if (Clock::now() >= deadline) return std::nullopt;
    drain_errors();
    std::this_thread::sleep_for(2ms);
  }
}

Reply WorkerProcess::reply_for_ending(const Ending& ending) const {
  if (WIFSIGNALED(ending.wait_status)) throw_if_ended_with_us(WTERMSIG(ending.wait_status));
  const std::string words = printable(last_words_, kDetailCharacters);
  const std::string said = words.empty() ? "" : "; it said: " + words;
  const bool signalled = WIFSIGNALED(ending.wait_status);
  const std::string cause = signalled ? signal_name(WTERMSIG(ending.wait_status))
                                      : "exit code " + std::to_string(WEXITSTATUS(ending.wait_status));
  const bool full = memory_mib_ > 0 && static_cast<double>(ending.peak_kib) >
                                           kMemoryShare * 1024.0 * static_cast<double>(memory_mib_);
  if (full || speaks_of_memory(last_words_)) {
    return failure(record::Status::kMemory,
                   cause + " for lack of memory (limit " + std::to_string(memory_mib_) + " MiB)" + said);
  }
  return failure(record::Status::kCrash, (signalled ? cause : cause + " without an answer") + said);
}

Reply WorkerProcess::broken_protocol(const std::string& what) {
  kill();
  return failure(record::Status::kError, "the worker broke the protocol: it " + what);
}

Reply WorkerProcess::lost_output() {
  if (const auto ending = reap_within(kTermGrace)) return reply_for_ending(*ending);
  return broken_protocol("closed its output");
}

void WorkerProcess::ask_to_quit() {
  if (input_ < 0) return;  // it is gone, or was asked
  write_all(input_, json({{"request", "quit"}}).dump() + "\n");
  close_fd(input_);
}

bool WorkerProcess::quit(std::chrono::milliseconds patience) {
  if (!alive()) return true;
  ask_to_quit();
  if (reap_within(patience)) return true;
  kill();
  return false;
}

void WorkerProcess::kill() {
  if (!alive()) return;
  ::kill(-pid_, SIGTERM);
  if (reap_within(kTermGrace)) return;
  ::kill(-pid_, SIGKILL);
  reap();
}

bool WorkerProcess::reset_peak_memory() const {
  if (!alive()) return false;
  // "5" resets nothing but VmHWM (proc(5)).
  std::ofstream file("/proc/" + std::to_string(pid_) + "/clear_refs");
  file << "5" << std::flush;
  return file.good();
}

std::optional<std::int64_t> WorkerProcess::peak_memory_bytes() const {
  if (!alive()) return std::nullopt;
  std::ifstream file("/proc/" + std::to_string(pid_) + "/status");
  for (std::string word; file >> word;) {
    std::int64_t kib = 0;
    if (word == "VmHWM:" && file >> kib) return kib * 1024;
  }
  return std::nullopt;
}

void WorkerProcess::close_pipes() {
  for (int* fd : {&input_, &replies_, &errors_}) close_fd(*fd);
}

}  // namespace hullbench::worker
