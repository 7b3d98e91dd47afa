# The core's tests. Those that need nothing but the core are built in a core-only build too; there the predicates'
# test joins them when Boost's headers are at hand.
add_library(hullbench_test_support STATIC point_sets.cpp hull_oracle.cpp)
target_include_directories(hullbench_test_support PUBLIC "${PROJECT_SOURCE_DIR}")
target_link_libraries(hullbench_test_support PUBLIC polylidar::core polylidar::check PRIVATE hullbench::compile_options)

hullbench_test(test_delaunay SOURCES test_delaunay.cpp LIBRARIES hullbench_test_support LABELS core)
hullbench_test(test_concave_hull SOURCES test_concave_hull.cpp LIBRARIES hullbench_test_support LABELS core)
hullbench_test(test_automatic_limit SOURCES test_automatic_limit.cpp LIBRARIES hullbench_test_support LABELS core)
hullbench_test(test_interior SOURCES test_interior.cpp LIBRARIES hullbench_test_support LABELS core)
hullbench_test(test_certificate SOURCES test_certificate.cpp LIBRARIES hullbench_test_support LABELS core)
hullbench_test(test_window_sample SOURCES test_window_sample.cpp LIBRARIES hullbench_test_support LABELS core)
hullbench_test(test_stream SOURCES test_stream.cpp LIBRARIES hullbench_test_support LABELS core)
hullbench_test(test_count_triangles SOURCES test_count_triangles.cpp LIBRARIES hullbench_test_support LABELS core)
hullbench_test(test_threads SOURCES test_threads.cpp LIBRARIES hullbench_test_support LABELS core)
hullbench_test(test_core_corpus SOURCES test_core_corpus.cpp LIBRARIES hullbench_test_support LABELS core)
hullbench_test(test_core_relations SOURCES test_core_relations.cpp LIBRARIES hullbench_test_support LABELS core)

# The fuzz target twice: for libFuzzer, which only clang has, and with a main of its own that runs the kept corpus, which
# makes it a test with every compiler.
option(HULLBENCH_FUZZ "Build the fuzz target for libFuzzer; CMAKE_CXX_FLAGS must say -fsanitize=fuzzer-no-link" OFF)
set(fuzz_sources fuzz/fuzz_concave_hull.cpp fuzz/fuzz_input.cpp)
add_executable(replay_fuzz_corpus fuzz/replay.cpp ${fuzz_sources})
target_link_libraries(replay_fuzz_corpus PRIVATE hullbench_test_support hullbench::compile_options)
set_target_properties(replay_fuzz_corpus PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/tests")
add_test(NAME fuzz.corpus_replay COMMAND replay_fuzz_corpus "${CMAKE_CURRENT_SOURCE_DIR}/fuzz/corpus")
set_tests_properties(fuzz.corpus_replay PROPERTIES LABELS core TIMEOUT 120)
if(HULLBENCH_FUZZ)
  add_executable(fuzz_concave_hull ${fuzz_sources})
  target_link_libraries(fuzz_concave_hull PRIVATE hullbench_test_support hullbench::compile_options)
  target_link_options(fuzz_concave_hull PRIVATE -fsanitize=fuzzer)
endif()

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
    LIBRARIES hullbench_test_support hullbench::metrics Boost::headers LABELS core)
endif()
