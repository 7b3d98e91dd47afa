// The field, benchmarks/plans/field.json: every way in which a method runs, of which plans take what they
// name.
#pragma once

#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/plan/plan_schema.hpp"

namespace hullbench::plan {

/// An entry of a plan's methods, and where it stands.
struct PlanEntry {
  json value;
  Place place;
};

/// All entries of `plan`, which its schema takes and which stands at `place`: first those of the field that
/// its "field" names and its "without" does not, in the field's order, then those of its "methods". One of
/// "methods" with the method and protocol of one of the field is a change of that: it says only what differs.
/// Throws ConfigurationError for a name that there is not, or that says nothing new.
std::vector<PlanEntry> entries_of(const json& plan, const Place& place);

}  // namespace hullbench::plan
