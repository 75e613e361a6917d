# SPDX-License-Identifier: Zlib
# Compiles the small Bullet that the tests of FindBulletSoftBody make prefixes of.
include("${CMAKE_CURRENT_LIST_DIR}/package_test.cmake")

configure("${CMAKE_CURRENT_LIST_DIR}/fake_bullet" "${WORK_DIR}/build")
run("${CMAKE_COMMAND}" --build "${WORK_DIR}/build")
