// A method as the harness starts it: built in, or described by a manifest.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "adapters/adapter.hpp"

namespace hullbench::worker {

/// How to start a method's worker, and what is known of the method before it has answered.
struct Method {
  std::string name;                  ///< as in plans and records
  std::string title;                 ///< as printed in tables
  std::vector<std::string> command;  ///< program and arguments of the worker
  std::optional<MethodInfo> info;    ///< of a manifest, without the version; none: the worker says it all
  std::vector<std::string> needs;    ///< files without which the method is not installed
  std::string install;               ///< the command that installs what is missing; may be empty
  bool jit = false;  ///< compiles while it runs, so it is warmed to a steady state before the first case
  /// The first digits of the hash of what it is made of beside its library; its version ends with them.
  /// May be empty.
  std::string sources;
};

/// The method of that name. Throws ConfigurationError when there is none.
using MethodFinder = std::function<Method(const std::string& name)>;

}  // namespace hullbench::worker
