# SPDX-License-Identifier: Zlib
# wetcloth_discover_test_files(<target> [PREFIX <prefix>] [WORKING_DIRECTORY <directory>] [LONGEST <name>...]): a CTest test
# for each test file of a GoogleTest program, named after it: tests/effects/Rain_test.cpp is <prefix>effects/Rain.
# GoogleTest's own gtest_discover_tests() makes one of each test case, and thousands of starts of a large program take
# longer than the tests themselves. Files are listed when CTest runs. The longest are started first, so that no processor
# waits for them at the end.
function(wetcloth_discover_test_files target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "PREFIX;WORKING_DIRECTORY" "LONGEST")
  if(NOT arg_WORKING_DIRECTORY)
    set(arg_WORKING_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}")
  endif()
  set(script "${CMAKE_CURRENT_BINARY_DIR}/${target}-files.cmake")
  file(
    GENERATE
    OUTPUT "${script}"
    CONTENT
      "set(program \"$<TARGET_FILE:${target}>\")
set(emulator \"${CMAKE_CROSSCOMPILING_EMULATOR}\")
set(sanitizers \"${WETCLOTH_SANITIZE}\")
set(prefix \"${arg_PREFIX}\")
set(directory \"${arg_WORKING_DIRECTORY}\")
set(listing \"${target}-tests.json\")
set(longest \"${arg_LONGEST}\")
include(\"${PROJECT_SOURCE_DIR}/cmake/WetclothListTestFiles.cmake\")
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES "${script}")
endfunction()
