#include "benchmarks/worker/worker.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "adapters/wkb.hpp"
#include "benchmarks/base/names.hpp"
#include "benchmarks/record/record.hpp"
#include "benchmarks/worker/protocol.hpp"

namespace hullbench::worker {
namespace {

using Clock = std::chrono::steady_clock;

std::int64_t nanoseconds(Clock::duration duration) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(duration).count();
}

/// Times a phase and the steps that the method names in it. Room for the steps is there before the clock
/// starts, so that naming one costs a clock reading.
class StepClock final : public Steps {
 public:
  void start() {
    count_ = 0;
    start_ = Clock::now();
  }
  void begin(std::string_view name) override {
    if (count_ < steps_.size()) steps_[count_++] = {name, Clock::now()};
  }
  void stop() { stop_ = Clock::now(); }

  /// Enters the phase and its steps; a step that was begun more than once is summed.
  void report(const std::string& phase, json& phases) const {
    phases[phase] = nanoseconds(stop_ - start_);
    for (std::size_t i = 0; i < count_; ++i) {
      const Clock::time_point end = i + 1 < count_ ? steps_[i + 1].second : stop_;
      json& total = phases[phase + "." + std::string(steps_[i].first)];
      total = (total.is_null() ? 0 : total.get<std::int64_t>()) + nanoseconds(end - steps_[i].second);
    }
  }

 private:
  Clock::time_point start_;
  Clock::time_point stop_;
  /// In the order they were begun; the first count_ are in use. Names are the method's string literals.
  std::array<std::pair<std::string_view, Clock::time_point>, 32> steps_;
  std::size_t count_ = 0;
};

/// The two file descriptors that the protocol keeps for itself, and lines over them.
class Channel {
 public:
  Channel()
      : in_(::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 3)), out_(::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3)) {
    const int nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
    ::dup2(nothing, STDIN_FILENO);
    ::close(nothing);
    ::dup2(STDERR_FILENO, STDOUT_FILENO);
  }

  /// The next line without its line feed; none at the end of the input or when a line is too long.
  std::optional<std::string> read_line() {
    while (true) {
      if (const std::size_t end = buffer_.find('\n'); end != std::string::npos) {
        std::string line = buffer_.substr(0, end);
        buffer_.erase(0, end + 1);
        return line;
      }
      std::array<char, 4096> chunk;
      const ssize_t count = ::read(in_, chunk.data(), chunk.size());
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0 || buffer_.size() > kMaxLineBytes) return std::nullopt;
      buffer_.append(chunk.data(), static_cast<std::size_t>(count));
    }
  }

  void write_line(const json& reply) {
    const std::string line = reply.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
    std::size_t written = 0;
    while (written < line.size()) {
      const ssize_t count = ::write(out_, line.data() + written, line.size() - written);
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) throw std::runtime_error("the harness does not listen any more");
      written += static_cast<std::size_t>(count);
    }
  }

 private:
  int in_;
  int out_;
  std::string buffer_;
};

json error_reply(const char* kind, const std::string& message) {
  return {{"error", {{"kind", kind}, {"message", message}}}};
}

/// Calls `action`, which returns a reply, and turns what it throws into an error reply.
template <typename Action>
json guarded(Action action) {
  try {
    return action();
  } catch (const NotInstalled& error) {
    json reply = error_reply("not_installed", error.what());
    reply["error"]["remedy"] = error.remedy();
    return reply;
  } catch (const Unsupported& error) {
    return error_reply("unsupported", error.what());
  } catch (const std::invalid_argument& error) {
    return error_reply("invalid_argument", error.what());
  } catch (const std::bad_alloc&) {
    return error_reply("memory", "the method ran out of memory");
  } catch (const std::exception& error) {
    return error_reply("error", error.what());
  } catch (...) {
    return error_reply("error", "the method threw something that is no std::exception");
  }
}

json load(Adapter& adapter, const json& request) {
  const auto points =
      read_points_file(request.at("points").get<std::string>(), request.at("n").get<std::size_t>());
  StepClock clock;
  clock.start();
  adapter.load(points);
  clock.stop();
  json phases = json::object();
  clock.report("load", phases);
  return {{"phases_ns", phases}};
}

json run(Adapter& adapter, const json& request) {
  const Parameters parameters = record::parameters_from_json(request.at("parameters"));
  StepClock run_clock;
  StepClock extract_clock;

  adapter.reset();
  run_clock.start();
  adapter.run(parameters, run_clock);
  run_clock.stop();

  extract_clock.start();
  const MultiPolygon shape = adapter.extract(extract_clock);
  extract_clock.stop();

  write_bytes(request.at("result").get<std::string>(), to_wkb(shape));
  json phases = json::object();
  run_clock.report("run", phases);
  extract_clock.report("extract", phases);
  return {{"nonce", request.at("nonce")}, {"phases_ns", phases}};
}

json answer(Adapter& adapter, const std::string& kind, const json& request) {
  if (kind == "load") return load(adapter, request);
  if (kind == "run") return run(adapter, request);
  return error_reply("error", "unknown request '" + kind + "'");
}

}  // namespace

ExitCode run_worker(const AdapterEntry& entry) {
  Channel channel;
  std::unique_ptr<Adapter> adapter;
  while (const std::optional<std::string> line = channel.read_line()) {
    const json request = json::parse(*line, nullptr, false);
    const bool is_request =
        request.is_object() && request.contains("request") && request["request"].is_string();
    const std::string kind = is_request ? request["request"].get<std::string>() : "";
    if (kind == "quit") return kExitOk;
    if (kind == "hello") {
      const json reply = guarded([&]() -> json {
        adapter = entry.make();
        return {{"protocol", kProtocolVersion}, {"method", method_to_json(adapter->info())}};
      });
      channel.write_line(reply);
      if (!adapter) return kExitError;
    } else if (!adapter) {
      channel.write_line(error_reply("error", "the first request must be 'hello'"));
      return kExitError;
    } else if (!is_request) {
      channel.write_line(error_reply("error", "this is no request"));
    } else {
      channel.write_line(guarded([&] { return answer(*adapter, kind, request); }));
    }
  }
  return kExitOk;
}

}  // namespace hullbench::worker
