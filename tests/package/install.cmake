# SPDX-License-Identifier: Zlib
# Installs the library and moves it, for the tests that use it. What is installed knows of no Eigen, and of no place.
include("${CMAKE_CURRENT_LIST_DIR}/package_test.cmake")

set(prefix "${WORK_DIR}/prefix")
file(REMOVE_RECURSE "${prefix}" "${INSTALLED}")
foreach(component IN ITEMS library ${PRECISIONS})
  run("${CMAKE_COMMAND}" --install "${BUILD_DIR}" --config "${CONFIG}" --prefix "${prefix}" --component ${component})
endforeach()

file(GLOB_RECURSE package_files "${prefix}/*.cmake" "${prefix}/*.pc" "${prefix}/*.h")
foreach(file IN LISTS package_files)
  file(READ "${file}" text)
  foreach(word IN ITEMS "Eigen3::" "include <Eigen/" "include <boost/" "${SOURCE_DIR}" "${BUILD_DIR}" "${prefix}")
    string(FIND "${text}" "${word}" position)
    if(NOT position EQUAL -1)
      message(FATAL_ERROR "${file} mentions ${word}")
    endif()
  endforeach()
endforeach()
file(RENAME "${prefix}" "${INSTALLED}")
