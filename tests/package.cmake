# The core as others get it: the installed package, used by the small project in package/, and the reference.
find_package(PkgConfig REQUIRED)
hullbench_test(test_package SOURCES test_package.cpp LIBRARIES hullbench_test_program LABELS package LIGHT)
target_compile_definitions(test_package PRIVATE
  HAS_GDAL=$<BOOL:${POLYLIDAR_WITH_GDAL}> BUILD_TYPE="$<LOWER_CASE:$<CONFIG>>" BUILD_FOLDER="${PROJECT_BINARY_DIR}"
  SOURCE_FOLDER="${PROJECT_SOURCE_DIR}" PROJECT_VERSION="${PROJECT_VERSION}"
  CMAKE_PROGRAM="${CMAKE_COMMAND}" CXX_COMPILER="${CMAKE_CXX_COMPILER}" PKG_CONFIG_PROGRAM="${PKG_CONFIG_EXECUTABLE}")
add_dependencies(test_package polylidar_core polylidar)

hullbench_tool_test(NAME docs.core NEEDS doxygen "${PROJECT_BINARY_DIR}/core/Doxyfile"
  COMMAND doxygen "${PROJECT_BINARY_DIR}/core/Doxyfile")
set_tests_properties(docs.core PROPERTIES LABELS package TIMEOUT 120)

hullbench_test(test_manual SOURCES test_manual.cpp LIBRARIES hullbench::manual hullbench_test_program LABELS package LIGHT)
target_compile_definitions(test_manual PRIVATE POLYLIDAR="$<TARGET_FILE:polylidar>" HAS_GDAL=$<BOOL:${POLYLIDAR_WITH_GDAL}>)
add_dependencies(test_manual polylidar)
if(TARGET polylidar_with_gdal)
  target_compile_definitions(test_manual PRIVATE POLYLIDAR_WITH_GDAL="$<TARGET_FILE:polylidar_with_gdal>")
  add_dependencies(test_manual polylidar_with_gdal)
endif()

# The Debian packages, made of what is built, unpacked and used.
get_property(packages GLOBAL PROPERTY HULLBENCH_DEBS)
list(JOIN packages " " packages)
hullbench_tool_test(NAME package.debs NEEDS "${SYSTEM_PYTHON}" dpkg-deb dpkg-shlibdeps file gzip lintian man
  COMMAND "${SYSTEM_PYTHON}" -B -m unittest test_debs)
set_tests_properties(package.debs PROPERTIES LABELS package TIMEOUT 300 COST ${HULLBENCH_COST_OF_LONG_TESTS} WORKING_DIRECTORY "${CMAKE_CURRENT_LIST_DIR}"
  ENVIRONMENT "HULLBENCH_BUILD=${PROJECT_BINARY_DIR};HULLBENCH_VERSION=${PROJECT_VERSION};HULLBENCH_PACKAGES=${packages};CMAKE=${CMAKE_COMMAND};CPACK=${CMAKE_CPACK_COMMAND};CXX=${CMAKE_CXX_COMPILER};POLYLIDAR_PYTHON=${POLYLIDAR_PYTHON}")
