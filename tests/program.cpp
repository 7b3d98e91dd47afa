#include "tests/program.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/capability.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "tests/complaint.hpp"

namespace hullbench::testing {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

fs::path new_file() {
  std::string name = (fs::temp_directory_path() / "hullbench-output-XXXXXX").string();
  const int fd = ::mkstemp(name.data());
  if (fd < 0) throw std::runtime_error("cannot make a temporary file");
  ::close(fd);
  return name;
}

void redirect(const fs::path& file, int to) {
  const int fd = ::open(file.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC);
  if (fd < 0 || ::dup2(fd, to) < 0) ::_exit(125);
}

[[noreturn]] void become(const std::vector<std::string>& command, const ProgramOptions& options,
                         const fs::path& out, const fs::path& err) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  redirect(out, STDOUT_FILENO);
  redirect(err, STDERR_FILENO);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) (void)::signal(signal, SIG_DFL);
  if (!options.folder.empty() && ::chdir(options.folder.c_str()) != 0) ::_exit(125);
  for (const auto& [name, value] : options.environment) ::setenv(name.c_str(), value.c_str(), 1);
  if (options.obey_permissions) {
    for (const int capability : {CAP_DAC_OVERRIDE, CAP_DAC_READ_SEARCH}) ::prctl(PR_CAPBSET_DROP, capability);
  }
  std::vector<char*> argv;
  argv.reserve(command.size() + 1);
  for (const std::string& argument : command) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  ::execvp(argv[0], argv.data());
  ::_exit(127);
}

fs::path folder_of(pid_t pid) {
  return fs::path("/proc") / std::to_string(pid);
}

std::vector<pid_t> all_processes() {
  std::vector<pid_t> processes;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string name = entry.path().filename().string();
    if (std::ranges::all_of(name, [](unsigned char c) { return std::isdigit(c) != 0; })) {
      processes.push_back(std::stoi(name));
    }
  }
  return processes;
}

/// The state letter and the parent of a process, from /proc; ' ' when there is none.
std::pair<char, pid_t> state_and_parent(const fs::path& folder) {
  std::ifstream in(folder / "stat");
  std::string text;
  std::getline(in, text);
  const auto name_end = text.rfind(')');
  if (name_end == std::string::npos) return {' ', -1};
  std::istringstream rest(text.substr(name_end + 1));
  char state = ' ';
  pid_t parent = -1;
  rest >> state >> parent;
  return {state, parent};
}

}  // namespace

Program::Program(const std::vector<std::string>& command, const ProgramOptions& options)
    : patience_(options.patience), out_(new_file()), err_(new_file()) {
  pid_ = ::fork();
  if (pid_ == 0) become(command, options, out_, err_);
  if (pid_ < 0) throw std::runtime_error("cannot fork");
}

Program::~Program() {
  if (pid_ > 0) {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  std::error_code ignored;
  fs::remove(out_, ignored);
  fs::remove(err_, ignored);
}

void Program::send_signal(int signal) const {
  ::kill(pid_, signal);
}

Outcome Program::wait() {
  int status = 0;
  const bool ended = wait_until([&] { return ::waitpid(pid_, &status, WNOHANG) == pid_; }, patience_);
  EXPECT_TRUE(ended) << "the program did not end; it said: " << read_text(err_);
  if (!ended) {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, &status, 0);
  }
  pid_ = -1;
  const int code = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  return {code, read_text(out_), read_text(err_)};
}

std::vector<std::string> joined(std::vector<std::string> words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

Outcome run_program(const std::vector<std::string>& command, const ProgramOptions& options) {
  return Program(command, options).wait();
}

Outcome succeeded(Outcome outcome) {
  if (outcome.code == 0) return outcome;
  throw std::runtime_error("exit code " + std::to_string(outcome.code) + ": " + outcome.err);
}

std::string missing(const std::vector<std::string>& needs) {
  const Outcome looked = run_program(joined(joined({NEEDS_SCRIPT}, needs), {"--", "true"}));
  if (looked.code != 0 && looked.code != 77) throw std::runtime_error(NEEDS_SCRIPT " failed: " + looked.err);
  return looked.out;
}

void expect_refusal(const Outcome& outcome, int code, const std::string& words) {
  EXPECT_EQ(outcome.code, code) << outcome.err;
  EXPECT_TRUE(outcome.err.starts_with("hullbench: ") || outcome.err.starts_with("polylidar: "))
      << outcome.err;
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
  expect_says(outcome.err, words);
  EXPECT_EQ(outcome.out, "");
}

Outcome expect_end(Outcome outcome, int code, const std::string& in_err, const std::string& in_out) {
  EXPECT_EQ(outcome.code, code) << outcome.err;
  expect_says(outcome.err, in_err);
  expect_says(outcome.out, in_out);
  return outcome;
}

bool wait_until(const std::function<bool()>& condition, std::chrono::milliseconds patience) {
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(2ms);
  }
  return true;
}

std::vector<pid_t> children_of(pid_t pid) {
  std::vector<pid_t> children;
  for (const pid_t candidate : all_processes()) {
    if (state_and_parent(folder_of(candidate)).second == pid) children.push_back(candidate);
  }
  return children;
}

bool runs_somewhere(const std::vector<std::string>& command) {
  std::string words;
  for (const std::string& word : command) words += word + '\0';
  const std::vector<pid_t> processes = all_processes();
  return std::ranges::any_of(processes,
                             [&](pid_t pid) { return read_text(folder_of(pid) / "cmdline") == words; });
}

bool is_running(pid_t pid) {
  const char state = state_and_parent(folder_of(pid)).first;
  return state != ' ' && state != 'Z' && state != 'X';
}

std::string read_text(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_text(const fs::path& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
}

}  // namespace hullbench::testing
