# SPDX-License-Identifier: Zlib
# What is installed compiles without a warning of an application's usual ones, each header by itself, in C++17 and 23,
# by every compiler that is here.
include("${CMAKE_CURRENT_LIST_DIR}/package_test.cmake")

set(SANITIZE "")
set(CXX_COMPILER_LAUNCHER "")
foreach(compiler IN ITEMS "${CXX_COMPILER}" ${OTHER_COMPILERS})
  cmake_path(GET compiler FILENAME name)
  # What a header forgot to include is the same for all: of two, the quicker compiler looks for it.
  set(alone OFF)
  if(name MATCHES "clang" OR NOT OTHER_COMPILERS)
    set(alone ON)
  endif()
  set(CXX_COMPILER "${compiler}")
  file(REMOVE_RECURSE "${WORK_DIR}/${name}")
  configure("${CMAKE_CURRENT_LIST_DIR}/headers" "${WORK_DIR}/${name}" "-DCMAKE_PREFIX_PATH=${INSTALLED}"
            -DALONE=${alone})
  run("${CMAKE_COMMAND}" --build "${WORK_DIR}/${name}" --parallel 1)
endforeach()
