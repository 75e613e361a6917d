# SPDX-License-Identifier: Zlib
# Without CMake: pkg-config tells what to compile and to link an application with, in each precision.
include("${CMAKE_CURRENT_LIST_DIR}/package_test.cmake")

file(GLOB folders "${INSTALLED}/lib*/pkgconfig" "${INSTALLED}/lib*/*/pkgconfig")
list(GET folders 0 folder)
set(ENV{PKG_CONFIG_PATH} "${folder}")
set(sanitize "")
if(SANITIZE)
  set(sanitize "-fsanitize=${SANITIZE}")
endif()

# compile(<module> <source>)
function(compile module source)
  run("${PKG_CONFIG}" --cflags --libs ${module})
  separate_arguments(flags UNIX_COMMAND "${output}")
  run("${CXX_COMPILER}" -std=c++17 "${CMAKE_CURRENT_LIST_DIR}/consumer/${source}" -o "${WORK_DIR}/${module}" ${flags}
      ${sanitize})
  run("${WORK_DIR}/${module}")
  set(output "${output}" PARENT_SCOPE)
endfunction()

foreach(precision IN LISTS PRECISIONS)
  precision_suffix(${precision} suffix)
  compile(bullet_wetcloth${suffix} main.cpp)
  must_match("${output}" "capacity 0.84, ${precision}")
endforeach()
compile(bullet_wetcloth_collision collision.cpp)
