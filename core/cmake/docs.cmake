# The target "docs": the public headers as HTML in docs/core of the build folder. Any warning of Doxygen's fails it.
if(NOT hullbench_IS_TOP_LEVEL)
  return()  # a project that embeds this one may have a target "docs" of its own
endif()
find_program(DOXYGEN_PROGRAM doxygen)
if(NOT DOXYGEN_PROGRAM)
  message(STATUS "docs: cannot be built, Doxygen is missing (apt-get install doxygen)")
  return()
endif()
set(docs_folder "${CMAKE_BINARY_DIR}/docs/core")
configure_file(Doxyfile.in Doxyfile @ONLY)
file(MAKE_DIRECTORY "${docs_folder}")
add_custom_target(docs
  COMMAND "${DOXYGEN_PROGRAM}" "${CMAKE_CURRENT_BINARY_DIR}/Doxyfile"
  COMMENT "The core's reference: ${docs_folder}/html/index.html"
  VERBATIM)
