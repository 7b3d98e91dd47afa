// The schema of plans as part of the program. The file that defines it is generated.
#pragma once

#include <string_view>

namespace hullbench::plan {

extern const std::string_view kPlanSchemaJson;  ///< benchmarks/plans/plan.schema.json

}  // namespace hullbench::plan
