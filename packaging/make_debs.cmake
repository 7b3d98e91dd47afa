# Called by the targets "debs" and "deb_PACKAGE": runs CPack and names the packages. CPack's own words are shown only if it fails,
# as it warns of packages that rightly depend on nothing.
#   CPACK       the program
#   CONFIG      its configuration
#   FOLDER      where the packages go; what was there is removed, so that they are not beside those of another version
#   COMPONENTS  what is packed; everything if it is empty
set(command "${CPACK}" --config "${CONFIG}" -B "${FOLDER}")
if(COMPONENTS)
  string(REPLACE ";" "\\;" one_word "${COMPONENTS}")
  list(APPEND command -D "CPACK_COMPONENTS_ALL=${one_word}")
endif()
file(REMOVE_RECURSE "${FOLDER}")
execute_process(COMMAND ${command} OUTPUT_VARIABLE said ERROR_VARIABLE said RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "CPack failed:\n${said}")
endif()
file(GLOB debs "${FOLDER}/*.deb")
foreach(deb IN LISTS debs)
  message(STATUS "${deb}")
endforeach()
