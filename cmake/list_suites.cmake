# Writes the ctest entries of a gtest program: test_suites.cmake.
#   cmake -D PROGRAM=FILE -D LABEL=NAME -D OUTPUT=FILE -P list_suites.cmake
execute_process(COMMAND ${PROGRAM} --gtest_list_tests
  OUTPUT_VARIABLE listed RESULT_VARIABLE result TIMEOUT 60)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} --gtest_list_tests fails: ${result}")
endif()
# A line "Suite." or "Instance/Suite." before the test cases; type parameters follow as a comment.
string(REGEX MATCHALL "(^|\n)[^ \n]+\\.( |\n)" lines "${listed}")
set(content "")
foreach(line ${lines})
  string(REGEX REPLACE "\\.[ \n]$" "" suite "${line}")
  string(STRIP "${suite}" suite)
  # An entry is skipped if no test case passed or failed.
  string(APPEND content
    "add_test([=[${suite}]=] [=[${PROGRAM}]=] [=[--gtest_filter=${suite}.*]=])\n"
    "set_tests_properties([=[${suite}]=] PROPERTIES LABELS [=[${LABEL}]=] TIMEOUT 1800\n"
    "  SKIP_REGULAR_EXPRESSION [=[PASSED  \\] 0 tests\\.\n(\\[  SKIPPED \\][^\n]*\n)+$]=])\n")
endforeach()
file(WRITE ${OUTPUT} "${content}")
