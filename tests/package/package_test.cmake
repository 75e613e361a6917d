# SPDX-License-Identifier: Zlib
# What the package tests share: the facts about the build under test, and steps that fail with their output.
cmake_minimum_required(VERSION 3.21)
include("${FACTS}")
set(TESTED_COMPILER "${CXX_COMPILER}")

# Projects that a test configures find what this build found, where it found it, unless the test says otherwise. What
# the person who runs the tests has in the environment must not decide.
foreach(name IN ITEMS Bullet_ROOT BULLET_ROOT_DIR BulletSoftBody_ROOT Bullet_DIR)
  unset(ENV{${name}})
endforeach()
set(ENV{BULLET_ROOT} "${BULLET_PREFIX}")
set(ENV{CMAKE_PREFIX_PATH} "${PREFIX_PATH}")
set(ENV{CMAKE_TOOLCHAIN_FILE} "${TOOLCHAIN_FILE}")
file(MAKE_DIRECTORY "${WORK_DIR}")

# "" for float32, "-float64" for float64
function(precision_suffix precision result)
  set(${result} "" PARENT_SCOPE)
  if(NOT precision STREQUAL "float32")
    set(${result} "-${precision}" PARENT_SCOPE)
  endif()
endfunction()

# From here on the compiler is clang, if it is here: without optimizing it takes a third of GCC's time.
macro(use_quick_compiler)
  if(OTHER_COMPILERS MATCHES "clang" AND NOT SANITIZE)
    list(GET OTHER_COMPILERS 0 CXX_COMPILER)
  endif()
endmacro()

# make_prefix(<prefix> <precision>): this build's Bullet under the names that Bullet's own install gives
function(make_prefix prefix precision)
  file(REMOVE_RECURSE "${prefix}")
  file(MAKE_DIRECTORY "${prefix}/include" "${prefix}/lib")
  file(CREATE_LINK "${BULLET_INCLUDE}" "${prefix}/include/bullet" SYMBOLIC)
  foreach(library IN LISTS BULLET_LIBRARIES_${precision})
    get_filename_component(name "${library}" NAME)
    string(REPLACE "-float64" "" name "${name}")
    file(CREATE_LINK "${library}" "${prefix}/lib/${name}" SYMBOLIC)
  endforeach()
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

# What this build has proven about Bullet installations. A proof is named by all that it rests on, so that another
# compiler, other flags or another installation are tried anew; whether there is type information, about its Bullet alone.
file(STRINGS "${BUILD_DIR}/CMakeCache.txt" BULLET_PROOFS
     REGEX "^(_BULLET_PROOF_[0-9a-f]+|WETCLOTH_BULLET_HAS_TYPEINFO):INTERNAL=")
list(TRANSFORM BULLET_PROOFS PREPEND "-D")

# The command that configures <source dir> in <build dir>. The objects of an earlier run stay, its cache does not; what
# this build found out about its compiler, CMake need not find out anew.
function(configure_command source_dir build_dir result)
  file(REMOVE "${build_dir}/CMakeCache.txt")
  if(CXX_COMPILER STREQUAL TESTED_COMPILER AND NOT EXISTS "${build_dir}/CMakeFiles")
    file(COPY "${BUILD_DIR}/CMakeFiles/${CMAKE_VERSION}" DESTINATION "${build_dir}/CMakeFiles")
  endif()
  set(flags "")
  if(SANITIZE)
    set(flags "-fsanitize=${SANITIZE}")
  endif()
  set(${result}
      "${CMAKE_COMMAND}" -S "${source_dir}" -B "${build_dir}" -G "${GENERATOR}" "-DCMAKE_CXX_COMPILER=${CXX_COMPILER}"
      "-DCMAKE_CXX_COMPILER_LAUNCHER=${CXX_COMPILER_LAUNCHER}" "-DCMAKE_CXX_FLAGS=${flags}" "-DCMAKE_BUILD_TYPE="
      "-DWETCLOTH_SOURCE_DIR=${SOURCE_DIR}" ${BULLET_PROOFS} ${ARGN} PARENT_SCOPE)
endfunction()

function(configure source_dir build_dir)
  configure_command("${source_dir}" "${build_dir}" command ${ARGN})
  run(${command})
  set(output "${output}" PARENT_SCOPE)
endfunction()

# must_fail(<command>... MATCHES <regex>...)
function(must_fail)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "" "MATCHES")
  try(status text ${arg_UNPARSED_ARGUMENTS})
  if(status EQUAL 0)
    message(FATAL_ERROR "Succeeded although it should not:\n${text}")
  endif()
  must_match("${text}" ${arg_MATCHES})
endfunction()

# configure_fails(<source dir> <build dir> <argument>... MATCHES <regex>...)
function(configure_fails source_dir build_dir)
  configure_command("${source_dir}" "${build_dir}" command ${ARGN})
  must_fail(${command})
endfunction()
