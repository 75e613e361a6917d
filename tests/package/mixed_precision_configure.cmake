# SPDX-License-Identifier: Zlib
# A target that links both precisions, of ours or one of ours and one of Bullet's, does not get past CMake.
include("${CMAKE_CURRENT_LIST_DIR}/package_test.cmake")

foreach(other IN ITEMS bullet_wetcloth::bullet_wetcloth-float64 Bullet::SoftBody-float64)
  configure_fails(
    "${CMAKE_CURRENT_LIST_DIR}/consumer" "${WORK_DIR}/build" -DMETHOD=add_subdirectory -DPRECISIONS=float32
    "-DALSO_LINK=${other}" MATCHES "INTERFACE_BULLET_PRECISION" "does not agree" "app-float32")
endforeach()
