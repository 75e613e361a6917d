# SPDX-License-Identifier: Zlib
# An installed bullet_wetcloth is found by find_package, with its Bullet, in each precision; its users need no
# Eigen, and it may be moved.
include("${CMAKE_CURRENT_LIST_DIR}/package_test.cmake")

set(prefix "${WORK_DIR}/prefix")
file(REMOVE_RECURSE "${prefix}")
run("${CMAKE_COMMAND}" --install "${BUILD_DIR}" --config "${CONFIG}" --prefix "${prefix}" --component library)

file(GLOB_RECURSE package_files "${prefix}/*.cmake")
foreach(file IN LISTS package_files)
  file(READ "${file}" text)
  foreach(word IN ITEMS "Eigen3::" "${SOURCE_DIR}" "${BUILD_DIR}" "${prefix}")
    string(FIND "${text}" "${word}" position)
    if(NOT position EQUAL -1)
      message(FATAL_ERROR "${file} mentions ${word}")
    endif()
  endforeach()
endforeach()

file(REMOVE_RECURSE "${prefix}-moved")
file(RENAME "${prefix}" "${prefix}-moved")

# In every precision without components, and each by its component.
set(consumer "${CMAKE_CURRENT_LIST_DIR}/consumer")
set(build "${WORK_DIR}/build")
string(REPLACE ";" "," all_precisions "${PRECISIONS}")
configure("${consumer}" "${build}" -DMETHOD=find_package "-DCMAKE_PREFIX_PATH=${prefix}-moved"
          "-DPRECISIONS=${all_precisions}")
run("${CMAKE_COMMAND}" --build "${build}")
foreach(precision IN LISTS PRECISIONS)
  run("${build}/app-${precision}")
  must_match("${output}" "capacity 0.84, ${precision}")
  configure("${consumer}" "${WORK_DIR}/component" -DMETHOD=find_package "-DCMAKE_PREFIX_PATH=${prefix}-moved"
            "-DPRECISIONS=${precision}" "-DCOMPONENTS=${precision}")
endforeach()
configure_fails(
  "${consumer}" "${WORK_DIR}/component" -DMETHOD=find_package "-DCMAKE_PREFIX_PATH=${prefix}-moved"
  -DCOMPONENTS=float16 MATCHES "float16")
configure_fails(
  "${consumer}" "${WORK_DIR}/component" -DMETHOD=find_package "-DCMAKE_PREFIX_PATH=${prefix}-moved"
  "-DBULLET_ROOT=${WORK_DIR}/nowhere" MATCHES "built with Bullet" "BULLET_ROOT")
