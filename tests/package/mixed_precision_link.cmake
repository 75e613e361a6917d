# SPDX-License-Identifier: Zlib
# Without CMake: code compiled for float32 that is given the float64 libraries does not link, and the message names
# the precision. The same line with BT_USE_DOUBLE_PRECISION does, so it is the precision that stops it.
include("${CMAKE_CURRENT_LIST_DIR}/package_test.cmake")

set(compile "${CXX_COMPILER}" -std=c++17 "${CMAKE_CURRENT_LIST_DIR}/consumer/main.cpp" "-I${SOURCE_DIR}"
            "-I${BUILD_DIR}/bullet_wetcloth/include" -isystem "${BULLET_INCLUDE}" -o "${WORK_DIR}/app")
set(libraries "${WETCLOTH_LIBRARY_float64}" "${COLLISION_LIBRARY}" ${BULLET_LIBRARIES_float64})
if(SANITIZE)
  list(APPEND libraries "-fsanitize=${SANITIZE}")
endif()

run(${compile} -DBT_USE_DOUBLE_PRECISION ${libraries})
try(status text ${compile} ${libraries})
if(status EQUAL 0)
  message(FATAL_ERROR "float32 code linked with the float64 library")
endif()
must_match("${text}" "undefined.*wetcloth::float32::")
