// Plans against their schema, benchmarks/plans/plan.schema.json.
#pragma once

#include <cstddef>
#include <string>

#include "benchmarks/base/names.hpp"

namespace hullbench::plan {

/// Where a value of a plan stands, for messages such as "plan 'states': methods[2].protocol must be ...".
class Place {
 public:
  /// `source` is how messages call the plan; `path` is empty for all of it.
  Place(std::string source, std::string path) : source_(std::move(source)), path_(std::move(path)) {}

  Place member(const std::string& key) const { return {source_, path_.empty() ? key : path_ + "." + key}; }
  Place element(std::size_t index) const { return {source_, path_ + "[" + std::to_string(index) + "]"}; }

  /// Throws ConfigurationError: the place, and `what` is wrong there.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  std::string source_;
  std::string path_;
};

/// Throws ConfigurationError for the first fault of `plan`, which stands at `place`.
void check_plan_schema(const json& plan, const Place& place);

/// The same of a plan's "methods" alone.
void check_methods_schema(const json& methods, const Place& place);

}  // namespace hullbench::plan
