# SPDX-License-Identifier: Zlib
# wetcloth_discover_test_suites(<target> PREFIX <prefix> [WORKING_DIRECTORY <directory>]): a CTest test for each test suite
# of a GoogleTest program. GoogleTest's own gtest_discover_tests() makes one of each test case, and thousands of starts of
# a large program take longer than the tests themselves. Suites are listed when CTest runs.
function(wetcloth_discover_test_suites target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "PREFIX;WORKING_DIRECTORY" "")
  if(NOT arg_WORKING_DIRECTORY)
    set(arg_WORKING_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}")
  endif()
  set(script "${CMAKE_CURRENT_BINARY_DIR}/${target}-suites.cmake")
  file(
    GENERATE
    OUTPUT "${script}"
    CONTENT
      "set(program \"$<TARGET_FILE:${target}>\")
set(prefix \"${arg_PREFIX}\")
set(directory \"${arg_WORKING_DIRECTORY}\")
include(\"${PROJECT_SOURCE_DIR}/cmake/WetclothListTestSuites.cmake\")
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES "${script}")
endfunction()
