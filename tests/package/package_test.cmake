# SPDX-License-Identifier: Zlib
# What the package tests share: the facts about the build under test, and steps that fail with their output.
cmake_minimum_required(VERSION 3.21)
include("${FACTS}")

# BULLET_ROOT of the person who runs the tests must not decide what they find.
unset(ENV{BULLET_ROOT})
file(MAKE_DIRECTORY "${WORK_DIR}")

# "" for float32, "-float64" for float64
function(precision_suffix precision result)
  set(${result} "" PARENT_SCOPE)
  if(NOT precision STREQUAL "float32")
    set(${result} "-${precision}" PARENT_SCOPE)
  endif()
endfunction()

# try(<status> <output> <command>...): both streams as one text
function(try status output)
  execute_process(
    COMMAND ${ARGN}
    RESULT_VARIABLE result
    OUTPUT_VARIABLE text
    ERROR_VARIABLE text)
  set(${status} "${result}" PARENT_SCOPE)
  set(${output} "${text}" PARENT_SCOPE)
endfunction()

# run(<command>...): must succeed; its output is left in the caller's `output`
function(run)
  try(status text ${ARGN})
  if(NOT status EQUAL 0)
    string(REPLACE ";" " " command "${ARGN}")
    message(FATAL_ERROR "Failed (${status}): ${command}\n${text}")
  endif()
  set(output "${text}" PARENT_SCOPE)
endfunction()

# must_match(<text> <regex>...)
function(must_match text)
  # CMake wraps its messages.
  string(REGEX REPLACE "[ \n]+" " " flat "${text}")
  foreach(regex IN LISTS ARGN)
    if(NOT flat MATCHES "${regex}")
      message(FATAL_ERROR "Expected to find \"${regex}\" in:\n${text}")
    endif()
  endforeach()
endfunction()

# The command that configures <source dir> in <build dir>. The objects of an earlier run stay, its cache does not.
function(configure_command source_dir build_dir result)
  file(REMOVE "${build_dir}/CMakeCache.txt")
  set(flags "")
  if(SANITIZE)
    set(flags "-fsanitize=${SANITIZE}")
  endif()
  set(${result}
      "${CMAKE_COMMAND}" -S "${source_dir}" -B "${build_dir}" -G "${GENERATOR}" "-DCMAKE_CXX_COMPILER=${CXX_COMPILER}"
      "-DCMAKE_CXX_COMPILER_LAUNCHER=${CXX_COMPILER_LAUNCHER}" "-DCMAKE_CXX_FLAGS=${flags}" "-DCMAKE_BUILD_TYPE="
      "-DWETCLOTH_SOURCE_DIR=${SOURCE_DIR}" ${ARGN} PARENT_SCOPE)
endfunction()

function(configure source_dir build_dir)
  configure_command("${source_dir}" "${build_dir}" command ${ARGN})
  run(${command})
  set(output "${output}" PARENT_SCOPE)
endfunction()

# configure_fails(<source dir> <build dir> <argument>... MATCHES <regex>...)
function(configure_fails source_dir build_dir)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "" "MATCHES")
  configure_command("${source_dir}" "${build_dir}" command ${arg_UNPARSED_ARGUMENTS})
  try(status text ${command})
  if(status EQUAL 0)
    message(FATAL_ERROR "Configured although it should not:\n${text}")
  endif()
  must_match("${text}" ${arg_MATCHES})
endfunction()
