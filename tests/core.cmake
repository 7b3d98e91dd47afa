# The core's tests. Those that need nothing but the core are built in a core-only build too; there the predicates'
# test joins them when Boost's headers are at hand.
add_library(hullbench_test_support STATIC point_sets.cpp hull_oracle.cpp)
target_include_directories(hullbench_test_support PUBLIC "${PROJECT_SOURCE_DIR}")
target_link_libraries(hullbench_test_support PUBLIC polylidar::core polylidar::check PRIVATE hullbench::compile_options)

hullbench_test(test_core
  SOURCES
    test_automatic_limit.cpp
    test_certificate.cpp
    test_concave_hull.cpp
    test_core_corpus.cpp
    test_core_relations.cpp
    test_count_triangles.cpp
    test_delaunay.cpp
    test_kernels.cpp
    test_outline_fill.cpp
    test_point_locator.cpp
    test_quantile.cpp
    test_reach.cpp
    test_size_filter.cpp
    test_stream.cpp
    test_widened_hull.cpp
    test_window_sample.cpp
  LIBRARIES hullbench_test_support LABELS core)
hullbench_test(test_interior SOURCES test_interior.cpp LIBRARIES hullbench_test_support LABELS core)
hullbench_test(test_threads SOURCES test_threads.cpp LIBRARIES hullbench_test_support LABELS core)

# Each fuzz target twice: for libFuzzer, which only clang has, and with a main of its own that runs the kept corpus, which
# makes it a test with every compiler.
option(HULLBENCH_FUZZ "Build the fuzz targets for libFuzzer; CMAKE_CXX_FLAGS must say -fsanitize=fuzzer-no-link" OFF)
if(HULLBENCH_FUZZ)
  add_custom_target(fuzz_programs)
endif()

# hullbench_fuzz(NAME SOURCES file... LIBRARIES target...): fuzz_NAME and replay_NAME, with the corpus in fuzz/corpus/NAME.
function(hullbench_fuzz name)
  cmake_parse_arguments(FUZZ "" "" "SOURCES;LIBRARIES;DEFINITIONS" ${ARGN})
  set(programs replay_${name})
  add_executable(replay_${name} fuzz/replay.cpp ${FUZZ_SOURCES})
  set_target_properties(replay_${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/tests")
  add_dependencies(test_programs replay_${name})
  add_test(NAME fuzz.${name}_replay COMMAND replay_${name} "${CMAKE_CURRENT_SOURCE_DIR}/fuzz/corpus/${name}")
  set_tests_properties(fuzz.${name}_replay PROPERTIES LABELS core TIMEOUT 120)
  if(HULLBENCH_FUZZ)
    list(APPEND programs fuzz_${name})
    add_executable(fuzz_${name} ${FUZZ_SOURCES})
    target_link_options(fuzz_${name} PRIVATE -fsanitize=fuzzer)
    add_dependencies(fuzz_programs fuzz_${name})
  endif()
  foreach(program IN LISTS programs)
    target_compile_definitions(${program} PRIVATE ${FUZZ_DEFINITIONS})
    target_link_libraries(${program} PRIVATE ${FUZZ_LIBRARIES} hullbench::compile_options)
  endforeach()
endfunction()

hullbench_fuzz(concave_hull
  SOURCES fuzz/fuzz_concave_hull.cpp fuzz/fuzz_input.cpp LIBRARIES hullbench_test_support)
if(TARGET polylidar_tool)
  add_library(hullbench_memory_file STATIC fuzz/memory_file.cpp)
  target_include_directories(hullbench_memory_file PUBLIC "${PROJECT_SOURCE_DIR}")
  target_link_libraries(hullbench_memory_file
    PUBLIC polylidar::tool PRIVATE nlohmann_json::nlohmann_json hullbench::compile_options)
  hullbench_fuzz(crs SOURCES fuzz/fuzz_crs.cpp LIBRARIES hullbench_memory_file)
  hullbench_fuzz(shard_file SOURCES fuzz/fuzz_shard_file.cpp LIBRARIES hullbench_memory_file)
  # One target a format; what they share is compiled once.
  add_library(hullbench_fuzz_point_files OBJECT fuzz/fuzz_point_files.cpp)
  target_link_libraries(hullbench_fuzz_point_files
    PRIVATE hullbench_memory_file nlohmann_json::nlohmann_json hullbench::compile_options)
  foreach(format IN ITEMS auto csv xyz geojson wkt npy raw ply las)
    hullbench_fuzz(${format} DEFINITIONS FUZZED_FORMAT="${format}"
      SOURCES fuzz/point_format.cpp $<TARGET_OBJECTS:hullbench_fuzz_point_files> LIBRARIES hullbench_memory_file)
  endforeach()
endif()
add_test(NAME fuzz.run COMMAND "${CMAKE_CURRENT_SOURCE_DIR}/fuzz/check_run.sh")
set_tests_properties(fuzz.run PROPERTIES LABELS core TIMEOUT 60)

if(HULLBENCH_CORE_ONLY)
  find_package(Boost QUIET)
else()
  find_package(Boost REQUIRED)
endif()
if(Boost_FOUND)
  hullbench_test(test_predicates SOURCES test_predicates.cpp
    LIBRARIES hullbench_test_support Boost::headers LABELS core)
else()
  message(STATUS "test_predicates: not built, Boost's headers are missing (apt-get install libboost-dev)")
endif()

if(NOT HULLBENCH_CORE_ONLY)
  find_package(CGAL REQUIRED)
  hullbench_test(test_delaunay_against_cgal SOURCES test_delaunay_against_cgal.cpp
    LIBRARIES hullbench_test_support CGAL::CGAL LABELS core)
  hullbench_test(test_concave_hull_validity SOURCES test_concave_hull_validity.cpp
    LIBRARIES hullbench_boost_checks hullbench_test_support hullbench::metrics LABELS core)
endif()
