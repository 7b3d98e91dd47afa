// A worker that speaks the protocol and misbehaves in the way its one argument names, which is also its
// method's name. By itself it is a method that returns the unit square.
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "adapters/wkb.hpp"
#include "benchmarks/worker/protocol.hpp"

namespace {

using namespace std::chrono_literals;
using nlohmann::json;

const hullbench::MultiPolygon kSquare = {{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {}}};
const hullbench::MultiPolygon kBowTie = {{{{0, 0}, {1, 1}, {1, 0}, {0, 1}}, {}}};

void say(const json& reply) {
  std::cout << reply.dump() << std::endl;
}

void say_error(const char* kind, const char* message) {
  say({{"error", {{"kind", kind}, {"message", message}}}});
}

[[noreturn]] void hang() {
  while (true) std::this_thread::sleep_for(1h);
}

void use_up_memory() {
  std::vector<std::unique_ptr<char[]>> blocks;
  while (true) blocks.push_back(std::make_unique<char[]>(std::size_t{16} * 1024 * 1024));
}

/// Takes 64 MiB and gives them back.
void borrow_memory() {
  std::vector<char> block(std::size_t{64} * 1024 * 1024, 'x');
  // Else the compiler may see that nobody looks.
  if (block[block.size() / 2] != 'x') std::exit(1);
}

/// Leaves a child that keeps every pipe open, and dies.
void leave_child_and_crash() {
  if (::fork() == 0) hang();
  (void)std::raise(SIGKILL);
}

/// Leaves a child in a session of its own, which its parent's group does not reach, with none of the pipes.
void leave_child_in_other_session(bool stubborn) {
  if (::fork() != 0) return;
  ::setsid();
  if (::fork() != 0) ::_exit(0);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::close(stream);
  if (stubborn) (void)std::signal(SIGTERM, SIG_IGN);  // cannot fail for this signal
  hang();
}

/// As many children as may be there at a time, each in a session of its own.
void fork_and_fork() {
  for (int i = 0; i < 100; ++i) {
    if (::fork() != 0) continue;
    ::setsid();
    hang();
  }
  hang();
}

[[noreturn]] void flood(std::FILE* stream, const char* text) {
  while (true) {
    static_cast<void>(std::fputs(text, stream));
    static_cast<void>(std::fflush(stream));
  }
}

/// Writes a result that does not end.
[[noreturn]] void flood_result(const json& request) {
  std::FILE* file = std::fopen(request["result"].get<std::string>().c_str(), "wb");
  const std::string block(1 << 20, 'x');
  flood(file, block.c_str());
}

json good_reply(const json& request) {
  return {{"nonce", request["nonce"]}, {"phases_ns", {{"run", 1000}, {"extract", 10}, {"run.shape", 900}}}};
}

/// Takes `run` and says so; `extract` is whatever is to be told.
void take_time(json& reply, std::chrono::microseconds run, int extract) {
  std::this_thread::sleep_for(run);
  reply["phases_ns"] = {{"run", std::chrono::nanoseconds(run).count()}, {"extract", extract}};
}

void write_result(const json& request, const hullbench::MultiPolygon& shape) {
  hullbench::worker::write_bytes(request["result"].get<std::string>(), hullbench::to_wkb(shape));
}

/// How often points were loaded.
int loads = 0;

/// Ways that end the worker or its conversation before it could answer.
bool misbehave_instead(const std::string& mode, const json& request) {
  if (mode == "crash") (void)std::raise(SIGSEGV);
  if (mode == "crash_on_second") {
    static int count = 0;
    if (++count == 2) (void)std::raise(SIGABRT);
  }
  if (mode == "hang") hang();
  if (mode == "hang_hard") {
    (void)std::signal(SIGTERM, SIG_IGN);  // cannot fail for this signal
    hang();
  }
  if (mode == "memory") use_up_memory();
  if (mode == "early_exit") {
    std::cerr << "I have seen enough\n";
    std::exit(7);
  }
  if (mode == "orphan") leave_child_and_crash();
  if (mode == "fork_and_crash") {
    leave_child_in_other_session(true);
    (void)std::raise(SIGSEGV);
  }
  if (mode == "fork_and_fork") fork_and_fork();
  if (mode == "flood_output") flood(stdout, "{}\n");
  if (mode == "flood_line") flood(stdout, "xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx");
  if (mode == "flood_errors_for_ever") flood(stderr, "this is not going well\n");
  if (mode == "flood_result") flood_result(request);
  if (mode == "close_output") {
    ::close(STDOUT_FILENO);
    hang();
  }
  if (mode == "garbage") {
    std::cout << "lorem ipsum" << std::endl;
  } else if (mode == "long_line") {
    std::cout << std::string(3 * hullbench::worker::kMaxLineBytes, 'x') << std::endl;
  } else if (mode == "says_memory") {
    say_error("memory", "no room");
  } else if (mode == "says_not_installed") {
    say_error("not_installed", "the server went down");
  } else if (mode == "fills_disk") {
    std::ofstream file(request["result"].get<std::string>() + ".too", std::ios::binary);
    while (file) file << std::string(1 << 16, 'x') << std::flush;
    say_error("error", "cannot write");
  } else if (mode == "loses_points" && loads < 2) {
    say_error("error", "the points are gone");
  } else if (mode == "says_unsupported") {
    say_error("unsupported", "not this many points");
  } else if (mode == "says_limits") {
    rlimit memory = {};
    getrlimit(RLIMIT_AS, &memory);
    say_error("error", (std::to_string(memory.rlim_cur >> 20) + " MiB").c_str());
  } else if (mode == "says_error") {
    say_error("error", "no luck");
  } else if (mode == "error_without_kind") {
    say({{"error", "broken"}});
  } else {
    return false;
  }
  return true;
}

/// Ways to answer that look right at first.
void answer_run(const std::string& mode, const json& request) {
  json reply = good_reply(request);
  if (mode == "borrows_memory_once") {
    static int count = 0;
    if (++count == 1) borrow_memory();
  }
  if (mode == "fork") leave_child_in_other_session(false);
  if (mode == "wrong_nonce") reply["nonce"] = "of yesterday";
  if (mode == "no_phases") reply.erase("phases_ns");
  if (mode == "negative_time") reply["phases_ns"]["run"] = -5;
  if (mode == "instant") reply["phases_ns"] = {{"run", 100}, {"extract", 10}};
  static int runs = 0;
  ++runs;
  if (mode == "counts_runs") reply["phases_ns"]["extract"] = runs;
  // 8, 4, 2 and then 1 ms, as of a compiler that has found what is worth its work.
  if (mode == "gets_faster") take_time(reply, runs < 90 ? 1ms * (8 >> std::min(runs - 1, 3)) : 800us, runs);
  if (mode == "takes_long") take_time(reply, 2s, runs);
  if (mode == "too_much_time") reply["phases_ns"]["run"] = 3'600'000'000'000;
  if (mode == "flood_errors") std::cerr << std::string(4'000'000, 'e') << std::flush;
  if (mode == "garbage_result") {
    hullbench::worker::write_bytes(request["result"].get<std::string>(), std::vector<std::uint8_t>{1, 2, 3});
  } else if (mode == "invalid_polygon") {
    write_result(request, kBowTie);
  } else if (mode == "changing_result") {
    static double size = 1;
    size += 1;
    write_result(request, {{{{0, 0}, {size, 0}, {size, size}}, {}}});
  } else if (mode == "changes_when_started") {
    write_result(request, {{{{0, 0}, {1.0 * ::getpid(), 0}, {1.0 * ::getpid(), 1}}, {}}});
  } else if (mode != "no_result") {
    write_result(request, kSquare);
  }
  if (mode == "unasked") {
    // In one piece, so that the second line is there when the first one is read.
    const std::string twice = reply.dump() + "\n" + reply.dump() + "\n";
    if (::write(STDOUT_FILENO, twice.data(), twice.size()) < 0) std::exit(1);
  } else {
    say(reply);
  }
}

json hello(const std::string& mode) {
  hullbench::MethodInfo info;
  info.name = mode == "other_name" ? "somebody" : mode;
  info.title = "Misbehaving";
  info.version = "1";
  info.capabilities.in_server = mode == "in_server";
  info.parameters = {{"size", "length", "Does nothing.", 0, 10, 1.0}};
  return {{"protocol", mode == "other_protocol" ? 2 : 1},
          {"version", info.version},
          {"method", hullbench::worker::method_to_json(info)}};
}

}  // namespace

int main(int argc, char** argv) {
  const std::string mode = argc > 1 ? argv[1] : "";
  // A crash on purpose must not leave a core file where the tests are run by hand.
  const rlimit no_core = {0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  for (std::string line; std::getline(std::cin, line);) {
    const json request = json::parse(line);
    if (request["request"] == "quit") return 0;
    if (request["request"] == "hello") {
      if (mode == "crash_at_start") (void)std::raise(SIGSEGV);
      say(hello(mode));
    } else if (request["request"] == "load") {
      if (mode == "crash_on_load") (void)std::raise(SIGBUS);
      ++loads;
      say({{"phases_ns", {{"load", 5}}}});
    } else if (!misbehave_instead(mode, request)) {
      answer_run(mode, request);
    }
  }
  return 0;
}
