# One ctest entry per suite of a gtest program. gtest_discover_tests() adds one per test case, and to
# start a program that links OpenImageIO takes longer than most test cases.
set(LAMPLIGHTER_LIST_SUITES ${CMAKE_CURRENT_LIST_DIR}/list_suites.cmake)

function(lamplighter_add_suites target label)
  set(suites ${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.cmake)
  set(include ${CMAKE_CURRENT_BINARY_DIR}/${target}_include.cmake)
  add_custom_command(TARGET ${target} POST_BUILD BYPRODUCTS ${suites}
    COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:${target}> -D LABEL=${label} -D OUTPUT=${suites}
      -P ${LAMPLIGHTER_LIST_SUITES} VERBATIM)
  file(CONFIGURE OUTPUT ${include} @ONLY CONTENT [[
if(EXISTS "@suites@")
  include("@suites@")
else()
  add_test(@target@_NOT_BUILT @target@_NOT_BUILT)
endif()
]])
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${include})
endfunction()
