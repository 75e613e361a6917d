# SPDX-License-Identifier: Zlib
# BULLET_ROOT names a prefix with one precision of Bullet, its libraries without a suffix, as a build of one's own
# installs them: that precision is told by linking, and nothing comes from the system.
include("${CMAKE_CURRENT_LIST_DIR}/package_test.cmake")

foreach(precision IN LISTS PRECISIONS)
  set(prefix "${WORK_DIR}/${precision}")
  make_prefix("${prefix}" ${precision})
  set(checks "-DEXPECTED_PRECISION=${precision}" "-DEXPECTED_PREFIX=${prefix}")
  configure("${CMAKE_CURRENT_LIST_DIR}/bullet_user" "${WORK_DIR}/build-${precision}" ${checks}
            "-DBULLET_ROOT=${prefix}")
  run("${CMAKE_COMMAND}" --build "${WORK_DIR}/build-${precision}")
  run("${WORK_DIR}/build-${precision}/user")
endforeach()

# The whole tree, with a Bullet of one precision: that half is built, and one line says so.
list(GET PRECISIONS -1 precision)
configure("${SOURCE_DIR}" "${WORK_DIR}/tree" "-DBULLET_ROOT=${WORK_DIR}/${precision}" -DWETCLOTH_BUILD_TESTS=OFF
          -DWETCLOTH_BUILD_COMMAND=OFF -DWETCLOTH_BUILD_EXAMPLES=OFF)
must_match("${output}" "that precision of bullet_wetcloth is not built")
