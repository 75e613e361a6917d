# SPDX-License-Identifier: Zlib
# Headers and libraries are of one installation, version and precision, or one line says what is wrong.
include("${CMAKE_CURRENT_LIST_DIR}/fake_prefix.cmake")

set(whole "${WORK_DIR}/whole")
fake_prefix("${whole}")
set(half "${WORK_DIR}/half")

# Half an installation comes first: the other half is not taken from the next one.
function(half_is_refused)
  search_in("${half}" "${whole}")
  refused(MATCHES "Bullet in ${half} is incomplete" ${ARGN})
  refused("-DBULLET_ROOT=${half}" MATCHES "Bullet in ${half} is incomplete" ${ARGN})
endfunction()

fake_prefix("${half}")
file(REMOVE_RECURSE "${half}/lib")
half_is_refused("it has headers, and no library BulletSoftBody in its lib")

fake_prefix("${half}")
file(REMOVE_RECURSE "${half}/include")
half_is_refused("it has libraries, and no headers: no BulletSoftBody/btSoftBody.h in its include/bullet")

fake_prefix("${half}")
file(REMOVE_RECURSE "${half}/lib")
fake_libraries("${half}/lib" float32 "" BulletSoftBody BulletDynamics BulletCollision)
half_is_refused("it has headers, and no library LinearMath in its lib")
# Two builds, each with a part of its own
fake_libraries("${half}/lib64" float32 "" LinearMath)
half_is_refused("it has headers, and no library LinearMath in its lib")

# Half an installation that comes later is nobody's business.
search_in("${whole}" "${half}")
found("${whole}")

# The version that counts is that of the libraries.
set(mixed "${WORK_DIR}/mixed")
fake_prefix("${mixed}")
fake_headers("${mixed}" 325)
refused("-DBULLET_ROOT=${mixed}" MATCHES "headers in ${mixed}/include/bullet are Bullet 3.25"
                                         "${mixed}/lib/[^ ]* and its siblings are 3.24")

# One library of the other precision
foreach(odd IN ITEMS BulletSoftBody BulletDynamics BulletCollision LinearMath)
  fake_prefix("${mixed}")
  file(GLOB library "${mixed}/lib/*${odd}.*")
  file(REMOVE "${library}")
  fake_libraries("${mixed}/lib" float64 "" ${odd})
  refused("-DBULLET_ROOT=${mixed}" MATCHES "A float32 program does not link with ${mixed}/lib"
                                           "A float64 program does not link with ${mixed}/lib" "undefined|unresolved")
endforeach()

# What an earlier configure proved is not believed of files that have changed.
fake_prefix("${mixed}" float32)
found("${mixed}" "-DBULLET_ROOT=${mixed}")
must_match("${output}" "${mixed}, float32 ")
fake_prefix("${mixed}" float64)
run("${CMAKE_COMMAND}" "${WORK_DIR}/build")
must_match("${output}" "${mixed}, float64 ")
