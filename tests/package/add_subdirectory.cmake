# SPDX-License-Identifier: Zlib
# A parent build takes the tree in by add_subdirectory: it gets the library and nothing else, and links to it from
# a directory that never called find_package.
include("${CMAKE_CURRENT_LIST_DIR}/package_test.cmake")

list(GET PRECISIONS 0 precision)
set(build "${WORK_DIR}/build")
configure("${CMAKE_CURRENT_LIST_DIR}/consumer" "${build}" -DMETHOD=add_subdirectory "-DPRECISIONS=${precision}"
          -DWETCLOTH_FILES_PER_OBJECT=16)
must_match("${output}" "uses Bullet of ${BULLET_PREFIX} ")
run("${CMAKE_COMMAND}" --build "${build}" --parallel 2 --target app-${precision})
run("${build}/app-${precision}")
must_match("${output}" "capacity 0.84, ${precision}")
