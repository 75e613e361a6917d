# SPDX-License-Identifier: Zlib
# BULLET_ROOT names a prefix with one precision of Bullet, its libraries without a suffix, as a build of one's own
# installs them: that precision is told by linking, and nothing comes from the system.
include("${CMAKE_CURRENT_LIST_DIR}/package_test.cmake")

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

foreach(precision IN LISTS PRECISIONS)
  set(prefix "${WORK_DIR}/${precision}")
  make_prefix("${prefix}" ${precision})
  set(checks "-DEXPECTED_PRECISION=${precision}" "-DEXPECTED_PREFIX=${prefix}")
  configure("${CMAKE_CURRENT_LIST_DIR}/bullet_user" "${WORK_DIR}/build-${precision}" ${checks}
            "-DBULLET_ROOT=${prefix}")
  run("${CMAKE_COMMAND}" --build "${WORK_DIR}/build-${precision}")
  run("${WORK_DIR}/build-${precision}/user")

  set(ENV{BULLET_ROOT} "${prefix}")
  configure("${CMAKE_CURRENT_LIST_DIR}/bullet_user" "${WORK_DIR}/build-environment" ${checks})
  unset(ENV{BULLET_ROOT})
endforeach()

# The whole tree, with a Bullet of one precision: that half is built, and one line says so.
list(GET PRECISIONS -1 precision)
configure("${SOURCE_DIR}" "${WORK_DIR}/tree" "-DBULLET_ROOT=${WORK_DIR}/${precision}" -DWETCLOTH_BUILD_TESTS=OFF)
must_match("${output}" "that precision of bullet_wetcloth is not built")
