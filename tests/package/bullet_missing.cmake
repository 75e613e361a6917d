# SPDX-License-Identifier: Zlib
# A Bullet that is not there, or does not link, is an error that says what to install; a prefix that was named is
# never quietly exchanged for the system's.
include("${CMAKE_CURRENT_LIST_DIR}/package_test.cmake")

set(advice "libbullet-dev" "libeigen3-dev" "brew install bullet eigen" "vcpkg install bullet3 eigen3" "bullet3/"
           "-DBULLET_ROOT=")

configure_fails("${SOURCE_DIR}" "${WORK_DIR}/build" "-DBULLET_ROOT=${WORK_DIR}/nowhere"
                MATCHES "was not found in BULLET_ROOT, ${WORK_DIR}/nowhere" ${advice})

# The system's, hidden
set(ENV{BULLET_ROOT})
file(MAKE_DIRECTORY "${WORK_DIR}/empty")
configure_fails("${SOURCE_DIR}" "${WORK_DIR}/build" "-DCMAKE_FIND_ROOT_PATH=${WORK_DIR}/empty"
                -DCMAKE_FIND_ROOT_PATH_MODE_INCLUDE=ONLY -DCMAKE_FIND_ROOT_PATH_MODE_LIBRARY=ONLY
                MATCHES "was not found in the system" ${advice})

# Headers and libraries that are no libraries
set(prefix "${WORK_DIR}/broken")
file(REMOVE_RECURSE "${prefix}")
file(MAKE_DIRECTORY "${prefix}/include" "${prefix}/lib")
file(CREATE_LINK "${BULLET_INCLUDE}" "${prefix}/include/bullet" SYMBOLIC)
list(GET PRECISIONS 0 precision)
foreach(library IN LISTS BULLET_LIBRARIES_${precision})
  get_filename_component(name "${library}" NAME)
  file(WRITE "${prefix}/lib/${name}" "not a library")
endforeach()
configure_fails("${SOURCE_DIR}" "${WORK_DIR}/build" "-DBULLET_ROOT=${prefix}"
                MATCHES "does not work" "does not link with ${prefix}/lib" ${advice})
