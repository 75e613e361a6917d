# SPDX-License-Identifier: Zlib
# A parent build takes the tree in by add_subdirectory: it gets the libraries and nothing else, as it wants libraries,
# and keeps its own settings and modules.
include("${CMAKE_CURRENT_LIST_DIR}/package_test.cmake")

foreach(shared IN ITEMS ON OFF)
  configure("${CMAKE_CURRENT_LIST_DIR}/guest" "${WORK_DIR}/shared-${shared}" -DSHARED=${shared})
endforeach()

# FetchContent does no more, once the tree is there.
list(GET PRECISIONS 0 precision)
configure("${CMAKE_CURRENT_LIST_DIR}/consumer" "${WORK_DIR}/fetched" -DMETHOD=fetch "-DPRECISIONS=${precision}")
must_match("${output}" "app-${precision} uses Bullet of ")
