# hullbench::record: what a run leaves behind. hullbench::report: reports, tables and validation made from it.
find_package(nlohmann_json 3.11 REQUIRED)
find_package(valijson REQUIRED)
find_package(PkgConfig REQUIRED)
find_package(LibLZMA REQUIRED)

add_library(hullbench_record STATIC record.cpp json_lines.cpp xz_file.cpp)
add_library(hullbench::record ALIAS hullbench_record)
target_include_directories(hullbench_record PUBLIC "${PROJECT_SOURCE_DIR}")
target_link_libraries(hullbench_record
  PUBLIC nlohmann_json::nlohmann_json hullbench::hash PRIVATE LibLZMA::LibLZMA hullbench::compile_options)

# hullbench::huge_pages: what the harness gives its workers, and what the report says of it.
add_library(hullbench_huge_pages STATIC huge_pages.cpp)
add_library(hullbench::huge_pages ALIAS hullbench_huge_pages)
target_include_directories(hullbench_huge_pages PUBLIC "${PROJECT_SOURCE_DIR}")
target_link_libraries(hullbench_huge_pages PUBLIC nlohmann_json::nlohmann_json PRIVATE hullbench::compile_options)

# The schemas and the paper's values become part of the program, so that it needs no file of its own at run time. A string literal
# may not be longer than 64 KiB in every compiler, and the files are cut into pieces to stay below.
function(hullbench_embed_json constant file)
  file(READ "${file}" text)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${file}")
  set(literals "")
  string(LENGTH "${text}" length)
  set(begin 0)
  while(begin LESS length)
    string(SUBSTRING "${text}" ${begin} 8000 piece)
    string(APPEND literals "\n    R\"json(${piece})json\"")
    math(EXPR begin "${begin} + 8000")
  endwhile()
  set(HULLBENCH_EMBEDDED "${HULLBENCH_EMBEDDED}const std::string_view ${constant} =${literals};\n" PARENT_SCOPE)
endfunction()
set(HULLBENCH_EMBEDDED "")
hullbench_embed_json(kRunSchemaJson "${PROJECT_SOURCE_DIR}/results/run.schema.json")
hullbench_embed_json(kReportSchemaJson "${PROJECT_SOURCE_DIR}/results/report.schema.json")
hullbench_embed_json(kPictureSchemaJson "${PROJECT_SOURCE_DIR}/results/picture.schema.json")
hullbench_embed_json(kTuneSchemaJson "${PROJECT_SOURCE_DIR}/results/tune.schema.json")
hullbench_embed_json(kSweepSchemaJson "${PROJECT_SOURCE_DIR}/results/sweep.schema.json")
hullbench_embed_json(kLeagueSchemaJson "${PROJECT_SOURCE_DIR}/results/league.schema.json")
hullbench_embed_json(kPaperJson "${PROJECT_SOURCE_DIR}/results/paper.json")
hullbench_embed_json(kManifestSchemaJson "${PROJECT_SOURCE_DIR}/adapters/process/manifest.schema.json")
file(CONFIGURE OUTPUT "${CMAKE_CURRENT_BINARY_DIR}/embedded.cpp"
  CONTENT "#include \"benchmarks/record/embedded.hpp\"\n\nnamespace hullbench {\n\n@HULLBENCH_EMBEDDED@\n}  // namespace hullbench\n"
  @ONLY)

# What the report says about the build. The options of a target are known only when CMake generates, hence file(GENERATE).
set(HULLBENCH_NATIVE_LITERAL $<IF:$<BOOL:${HULLBENCH_NATIVE}>,true,false>)
string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
set(HULLBENCH_COMMON_FLAGS "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${build_type}} -std=c++${CMAKE_CXX_STANDARD}")
set(HULLBENCH_TARGET_OPTIONS "")
get_property(adapter_lines GLOBAL PROPERTY HULLBENCH_ADAPTERS)
set(measured_targets polylidar_core)
foreach(line IN LISTS adapter_lines)
  string(REGEX REPLACE "\\|.*" "" adapter "${line}")
  list(APPEND measured_targets hullbench_adapter_${adapter})
endforeach()
foreach(target IN LISTS measured_targets)
  if(TARGET ${target})
    string(APPEND HULLBENCH_TARGET_OPTIONS
      "      {\"${target}\", R\"flags($<JOIN:$<REMOVE_DUPLICATES:$<TARGET_PROPERTY:${target},COMPILE_OPTIONS>>, >)flags\"},\n")
  endif()
endforeach()

set(HULLBENCH_LIBRARY_VERSIONS "")
foreach(module IN ITEMS geos sqlite3 spatialite libpq openssl CLI11)
  pkg_get_variable(has_${module} ${module} pcfiledir)
  if(has_${module})
    pkg_check_modules(module_${module} QUIET ${module})
    string(APPEND HULLBENCH_LIBRARY_VERSIONS "      {\"${module}\", \"${module_${module}_VERSION}\"},\n")
  endif()
endforeach()
# CGAL and Boost say their version in a header only; finding the whole package here would be for nothing.
foreach(entry IN ITEMS "cgal|CGAL/version.h|CGAL_VERSION ([0-9.]+)" "boost|boost/version.hpp|BOOST_LIB_VERSION \"([0-9_]+)\"")
  string(REPLACE "|" ";" fields "${entry}")
  list(GET fields 0 library)
  list(GET fields 1 header)
  list(GET fields 2 pattern)
  find_path(HULLBENCH_${library}_INCLUDE NAMES "${header}")
  mark_as_advanced(HULLBENCH_${library}_INCLUDE)
  if(HULLBENCH_${library}_INCLUDE)
    file(READ "${HULLBENCH_${library}_INCLUDE}/${header}" text)
    if(text MATCHES "define ${pattern}")
      string(REPLACE "_" "." version "${CMAKE_MATCH_1}")
      string(APPEND HULLBENCH_LIBRARY_VERSIONS "      {\"${library}\", \"${version}\"},\n")
    endif()
  endif()
endforeach()
configure_file(build_info.cpp.in "${CMAKE_CURRENT_BINARY_DIR}/build_info.cpp.configured" @ONLY)
file(GENERATE OUTPUT "${CMAKE_CURRENT_BINARY_DIR}/build_info.cpp"
  INPUT "${CMAKE_CURRENT_BINARY_DIR}/build_info.cpp.configured")

find_package(Boost REQUIRED)

add_library(hullbench_report STATIC
  bootstrap.cpp
  compare.cpp
  compare_document.cpp
  gbench_export.cpp
  rank_test.cpp
  ratios.cpp
  statistics.cpp
  environment.cpp
  claims.cpp
  collection_tables.cpp
  curve_table.cpp
  document.cpp
  group_values.cpp
  headline.cpp
  labels.cpp
  measurements.cpp
  noise.cpp
  number_format.cpp
  overview_tables.cpp
  paper_comparison.cpp
  report.cpp
  report_notes.cpp
  table_context.cpp
  text_table.cpp
  tables.cpp
  validate.cpp
  "${CMAKE_CURRENT_BINARY_DIR}/build_info.cpp"
  "${CMAKE_CURRENT_BINARY_DIR}/embedded.cpp")
add_library(hullbench::report ALIAS hullbench_report)
target_link_libraries(hullbench_report
  PUBLIC hullbench::record PRIVATE hullbench::huge_pages valijson Boost::headers hullbench::compile_options)
