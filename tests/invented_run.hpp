// A run directory with invented numbers, for tests of what is made from one.
#pragma once

#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/record/record.hpp"

namespace hullbench::testing {

/// run.json of the invented run.
json invented_run();

/// The name that a plan gives the run.
std::string run_name(const record::RunRecord& record);

/// A successful record with every field filled in, and its id and name.
record::RunRecord invented_record();

/// The records: three installed methods and a missing one in the paper protocol and one in the auto protocol,
/// on California with and without holes and on Hawaii, at the given sizes. On Hawaii, SpatiaLite runs out of
/// time at the largest size and PostGIS gives an invalid polygon.
std::vector<record::RunRecord> invented_records(const std::vector<std::int64_t>& sizes);

/// Writes the two files into `directory`, which is made.
void write_invented_run(const fs::path& directory, const std::vector<std::int64_t>& sizes);

}  // namespace hullbench::testing
