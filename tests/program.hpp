// Running programs from tests: with their output, in the background, with less power than ours.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace hullbench::testing {

/// How a program ended.
struct Outcome {
  int code = -1;    ///< exit code; 128 + the signal's number when a signal ended it
  std::string out;  ///< standard output
  std::string err;  ///< standard error
};

struct ProgramOptions {
  std::filesystem::path folder;                    ///< working directory; empty: ours
  std::map<std::string, std::string> environment;  ///< added to ours
  bool obey_permissions = false;  ///< even when we are root, who may otherwise write to every folder
  std::chrono::seconds patience = std::chrono::seconds(60);  ///< how long wait() waits
};

/// A program that runs beside the test; killed with this object.
class Program {
 public:
  explicit Program(const std::vector<std::string>& command, const ProgramOptions& options = {});
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  pid_t pid() const { return pid_; }
  void send_signal(int signal) const;
  /// Waits for its end; when it does not come in time, that is a test failure, and the program is killed.
  Outcome wait();

 private:
  pid_t pid_ = -1;
  std::chrono::seconds patience_;
  std::filesystem::path out_;
  std::filesystem::path err_;
};

/// The words of a command, and then more of them.
std::vector<std::string> joined(std::vector<std::string> words, const std::vector<std::string>& more);

/// Runs a program, which is looked for in PATH, to its end.
Outcome run_program(const std::vector<std::string>& command, const ProgramOptions& options = {});

/// `outcome`, when the program ended with 0; throws what it wrote to standard error when not.
Outcome succeeded(Outcome outcome);

/// What tests/needs.sh says is missing of `needs`, which are as it takes them; empty when all is there. A
/// test that needs it is then to be skipped.
std::string missing(const std::vector<std::string>& needs);

/// Expects that hullbench or polylidar ended with `code` and one sentence on standard error that has these
/// words, and wrote nothing to standard output.
void expect_refusal(const Outcome& outcome, int code, const std::string& words);

/// Expects that a program ended with `code` and said these words on standard error and on standard output, at
/// least; `outcome` itself.
Outcome expect_end(Outcome outcome, int code, const std::string& in_err, const std::string& in_out = "");

/// Calls `condition` until it is true; false when it is not within `patience`.
bool wait_until(const std::function<bool()>& condition,
                std::chrono::milliseconds patience = std::chrono::seconds(30));

/// The processes whose parent is `pid`.
std::vector<pid_t> children_of(pid_t pid);

/// Whether any process on this machine runs `command`, these very words.
bool runs_somewhere(const std::vector<std::string>& command);

/// Whether a process runs; one that has ended and was not waited for does not.
bool is_running(pid_t pid);

std::string read_text(const std::filesystem::path& path);
void write_text(const std::filesystem::path& path, const std::string& text);

}  // namespace hullbench::testing
