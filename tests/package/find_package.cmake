# SPDX-License-Identifier: Zlib
# An installed bullet_wetcloth is found by find_package, with its Bullet, in each precision, and its users build, as a
# program and as a plugin.
include("${CMAKE_CURRENT_LIST_DIR}/package_test.cmake")

# In every precision without components, and each by its component.
set(consumer "${CMAKE_CURRENT_LIST_DIR}/consumer")
set(build "${WORK_DIR}/build")
set(found -DMETHOD=find_package "-DCMAKE_PREFIX_PATH=${INSTALLED}")
string(REPLACE ";" "," all_precisions "${PRECISIONS}")
configure("${consumer}" "${build}" ${found} "-DPRECISIONS=${all_precisions}")
must_match("${output}" "uses Bullet of ${BULLET_PREFIX} ")
run("${CMAKE_COMMAND}" --build "${build}" --parallel 2)
foreach(precision IN LISTS PRECISIONS)
  run("${build}/app-${precision}")
  must_match("${output}" "capacity 0.84, ${precision}")
  configure("${consumer}" "${WORK_DIR}/component" ${found} "-DPRECISIONS=${precision}" "-DCOMPONENTS=${precision}")
endforeach()
if(NOT SANITIZE)  # whose runtime a host would have to bring
  run("${build}/host" "${build}/plugin.so")
endif()
configure_fails("${consumer}" "${WORK_DIR}/component" ${found} -DCOMPONENTS=float16 MATCHES "float16")
configure_fails("${consumer}" "${WORK_DIR}/component" ${found} "-DBULLET_ROOT=${WORK_DIR}/nowhere" MATCHES
                "built with Bullet" "was not found in BULLET_ROOT, ${WORK_DIR}/nowhere")

# A Bullet of one precision, for the package in both and for one in the other only
if("float32" IN_LIST PRECISIONS AND "float64" IN_LIST PRECISIONS)
  make_prefix("${WORK_DIR}/float64" float64)
  set(with_float64 "-DBULLET_ROOT=${WORK_DIR}/float64")
  configure_fails("${consumer}" "${WORK_DIR}/component" ${found} ${with_float64} -DCOMPONENTS=float32 MATCHES
                  "Component float32: .* With Bullet in BULLET_ROOT, ${WORK_DIR}/float64, there is float64")
  file(COPY "${INSTALLED}/" DESTINATION "${WORK_DIR}/changed")
  file(GLOB_RECURSE config "${WORK_DIR}/changed/*/bullet_wetclothConfig.cmake")
  file(READ "${config}" text)
  string(REPLACE "float32;float64" "float32" text "${text}")
  file(WRITE "${config}" "${text}")
  configure_fails("${consumer}" "${WORK_DIR}/component" -DMETHOD=find_package "-DCMAKE_PREFIX_PATH=${WORK_DIR}/changed"
                  ${with_float64} MATCHES "built in float32; Bullet in [^;]* is not of that precision")
endif()
