# Checks of the files themselves: each is one function of style/check.sh and can be run by hand.
foreach(check IN ITEMS format python javascript paths layout rooms printing version help)
  add_test(NAME style.${check} COMMAND "${PROJECT_SOURCE_DIR}/tests/style/check.sh" ${check})
  set_tests_properties(style.${check} PROPERTIES LABELS style SKIP_RETURN_CODE 77 TIMEOUT 120)
endforeach()
