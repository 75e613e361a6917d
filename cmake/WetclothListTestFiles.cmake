# SPDX-License-Identifier: Zlib
# Run by CTest, with `program`, `emulator`, `sanitizers`, `prefix`, `directory`, `listing` and `longest` set: see
# WetclothDiscoverTestFiles.cmake.
cmake_policy(VERSION 3.21)  # CTest has none
if(NOT EXISTS "${program}")
  add_test("${prefix}NOT_BUILT" "${program}")
  return()
endif()
# Several CTests may run in one folder.
file(LOCK "${directory}/${listing}.lock")
execute_process(
  COMMAND ${emulator} "${program}" --gtest_list_tests "--gtest_output=json:${listing}"
  WORKING_DIRECTORY "${directory}"
  OUTPUT_QUIET
  RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${program} could not list its tests: ${status}")
endif()

# suites_<name of a file>: a list. A suite is indented less than its cases, and its first case names its file.
set(names "")
file(STRINGS "${directory}/${listing}" lines REGEX "^(      \"name\"|          \"file\")")
file(LOCK "${directory}/${listing}.lock" RELEASE)
string(REPLACE "\\/" "/" lines "${lines}")
set(suite "")
foreach(line IN LISTS lines)
  if(line MATCHES "^      \"name\": \"(.*)\"")
    set(suite "${CMAKE_MATCH_1}")
    set(file_of_suite "")
  elseif(NOT line STREQUAL file_of_suite)
    if(file_of_suite)
      message(FATAL_ERROR "The suite ${suite} is in two files, of which each is to be run by its suites:${line}")
    endif()
    set(file_of_suite "${line}")
    string(REGEX REPLACE "^.*/tests/|(_test)?\\.cpp.*$" "" name "${line}")
    if(NOT name IN_LIST names)
      list(APPEND names "${name}")
      set("suites_${name}" "")
    endif()
    list(APPEND "suites_${name}" "${suite}.*")
  endif()
endforeach()

# What GoogleTest says last where every test was skipped; where one failed as well, more follows. It only says so without
# --gtest_brief.
set(all_skipped "\\[  PASSED  \\] 0 tests\\.\r?\n(\\[  SKIPPED \\][^\n]*\n)+$")
# Seconds; an emulator and the thread sanitizer take ten times as long.
set(timeout 600)
if(emulator OR sanitizers)
  set(timeout 6000)
endif()
foreach(name IN LISTS names)
  list(JOIN "suites_${name}" ":" filter)
  add_test("${prefix}${name}" ${emulator} "${program}" "--gtest_filter=${filter}")
  set_tests_properties("${prefix}${name}" PROPERTIES WORKING_DIRECTORY "${directory}" TIMEOUT ${timeout}
                                                     SKIP_REGULAR_EXPRESSION "${all_skipped}"
                                                     FAIL_REGULAR_EXPRESSION "Running 0 tests")
  list(FIND longest "${name}" place)
  if(NOT place EQUAL -1)
    math(EXPR cost "1000 - ${place}")
    set_tests_properties("${prefix}${name}" PROPERTIES COST ${cost})
  endif()
endforeach()
