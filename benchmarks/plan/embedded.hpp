// The schema of plans and their field as parts of the program. The file that defines it is generated.
#pragma once

#include <string_view>

namespace hullbench::plan {

extern const std::string_view kPlanSchemaJson;  ///< benchmarks/plans/plan.schema.json
extern const std::string_view kFieldJson;       ///< benchmarks/plans/field.json

}  // namespace hullbench::plan
