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
must_match("${output}" "uses Bullet of ${BULLET_PREFIX} ")
run("${CMAKE_COMMAND}" --build "${build}")
foreach(precision IN LISTS PRECISIONS)
  run("${build}/app-${precision}")
  must_match("${output}" "capacity 0.84, ${precision}")
  run("${CMAKE_COMMAND}" "${build}" "-DPRECISIONS=${precision}" "-DCOMPONENTS=${precision}")
endforeach()
must_fail("${CMAKE_COMMAND}" "${build}" -DCOMPONENTS=float16 MATCHES "float16")
must_fail("${CMAKE_COMMAND}" "${build}" -DCOMPONENTS= "-DBULLET_ROOT=${WORK_DIR}/nowhere"
          MATCHES "built with Bullet" "was not found in BULLET_ROOT, ${WORK_DIR}/nowhere")

# A Bullet of one precision, for the package in both and for one in the other only
if("float32" IN_LIST PRECISIONS AND "float64" IN_LIST PRECISIONS)
  make_prefix("${WORK_DIR}/float64" float64)
  set(with_float64 "${CMAKE_COMMAND}" "${build}" "-DBULLET_ROOT=${WORK_DIR}/float64")
  must_fail(${with_float64} -DCOMPONENTS=float32
            MATCHES "Component float32: .* With Bullet in BULLET_ROOT, ${WORK_DIR}/float64, there is float64")
  file(GLOB_RECURSE config "${prefix}-moved/*/bullet_wetclothConfig.cmake")
  file(READ "${config}" text)
  string(REPLACE "float32;float64" "float32" text "${text}")
  file(WRITE "${config}" "${text}")
  must_fail(${with_float64} -DCOMPONENTS= MATCHES "built in float32; Bullet in [^;]* is not of that precision")
endif()
