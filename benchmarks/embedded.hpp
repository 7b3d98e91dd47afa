// The JSON files that are part of the program, as text. The file that defines them is generated from
// results/*.json.
#pragma once

#include <string_view>

namespace hullbench {

extern const std::string_view kRunSchemaJson;     ///< results/run.schema.json
extern const std::string_view kReportSchemaJson;  ///< results/report.schema.json
extern const std::string_view kPaperJson;         ///< results/paper.json

}  // namespace hullbench
