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
                "built with Bullet" "BULLET_ROOT")
