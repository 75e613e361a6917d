# SPDX-License-Identifier: Zlib
# Run by CTest, with `program`, `prefix` and `directory` set: see WetclothDiscoverTestSuites.cmake.
if(NOT EXISTS "${program}")
  add_test("${prefix}NOT_BUILT" "${program}")
  return()
endif()
execute_process(
  COMMAND "${program}" --gtest_list_tests
  WORKING_DIRECTORY "${directory}"
  OUTPUT_VARIABLE listing
  RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${program} could not list its tests: ${status}")
endif()
# What GoogleTest says last of a suite of which every test was skipped; where one failed as well, more follows. It only
# says so without --gtest_brief.
set(all_skipped "\\[  PASSED  \\] 0 tests\\.\n(\\[  SKIPPED \\][^\n]*\n)+$")
# A suite's name begins its line and ends with a dot; its cases are indented.
string(REPLACE ";" " " listing "${listing}")
string(REPLACE "\n" ";" lines "${listing}")
foreach(line IN LISTS lines)
  if(line MATCHES "^([A-Za-z0-9_/]+)\\.")
    set(suite "${CMAKE_MATCH_1}")
    string(REGEX REPLACE "^/" "" name "${suite}")
    add_test("${prefix}${name}" "${program}" "--gtest_filter=${suite}.*")
    set_tests_properties("${prefix}${name}" PROPERTIES WORKING_DIRECTORY "${directory}" TIMEOUT 600
                                                       SKIP_REGULAR_EXPRESSION "${all_skipped}")
  endif()
endforeach()
