# SPDX-License-Identifier: Zlib
# A Bullet that is too old, or not the one that is asked for, is refused in one line that says which versions work.
include("${CMAKE_CURRENT_LIST_DIR}/fake_prefix.cmake")

set(prefix "${WORK_DIR}/prefix")
fake_prefix("${prefix}")
foreach(old IN ITEMS 288 289)
  fake_headers("${prefix}" ${old})
  string(REGEX REPLACE "^2" "2." version ${old})
  refused("-DBULLET_ROOT=${prefix}" "-DASKED=3.05"
          MATCHES "${prefix} is version ${version}, and it has to be 3.05 or newer: 3.05 to 3.26 are known to work")
endforeach()

fake_headers("${prefix}" 324)
found("${prefix}" "-DBULLET_ROOT=${prefix}" "-DASKED=3.23")
must_match("${output}" "version 3.24")
refused("-DBULLET_ROOT=${prefix}" "-DASKED=3.25 EXACT"
        MATCHES "version 3.24, and it has to be exactly 3.25: Bullet keeps")
refused("-DBULLET_ROOT=${prefix}" "-DASKED=3.23 COMPONENTS float64"
        MATCHES "has no libraries of component float64. A float64 program does not link")
