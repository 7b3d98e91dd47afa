// The JSON files that are part of the program, as text. The file that defines them is generated from
// results/*.json, protocols.json and the manifests' schema.
#pragma once

#include <string_view>

namespace hullbench::record {

extern const std::string_view kRunSchemaJson;         ///< results/run.schema.json
extern const std::string_view kReportSchemaJson;      ///< results/report.schema.json
extern const std::string_view kPictureSchemaJson;     ///< results/picture.schema.json
extern const std::string_view kTuneSchemaJson;        ///< results/tune.schema.json
extern const std::string_view kSweepSchemaJson;       ///< results/sweep.schema.json
extern const std::string_view kLeagueSchemaJson;      ///< results/league.schema.json
extern const std::string_view kTablesSchemaJson;      ///< results/tables.schema.json
extern const std::string_view kSubmissionSchemaJson;  ///< results/submission.schema.json
extern const std::string_view kPaperJson;             ///< results/paper.json
extern const std::string_view kManifestSchemaJson;    ///< adapters/process/manifest.schema.json
extern const std::string_view kProtocolsJson;         ///< protocols.json

}  // namespace hullbench::record
