# SPDX-License-Identifier: Zlib
# Every usual way to name a prefix is heard, and whoever names one gets that one or an error.
include("${CMAKE_CURRENT_LIST_DIR}/fake_prefix.cmake")

set(prefix "${WORK_DIR}/prefix")
set(other "${WORK_DIR}/other")
foreach(each IN ITEMS "${prefix}" "${other}" "${WORK_DIR}/root/usr")
  fake_prefix("${each}" float32)
  fake_libraries("${each}/lib" float64 "-float64")
endforeach()
search_in("${other}")
found("${other}")

foreach(name IN ITEMS BULLET_ROOT Bullet_ROOT BULLET_ROOT_DIR BulletSoftBody_ROOT Bullet_DIR)
  found("${prefix}" "-D${name}=${prefix}")
  must_match("${output}" "Found BulletSoftBody: ${name}, ${prefix}, float32, float64 ")

  set(ENV{${name}} "${prefix}")
  found("${prefix}")
  must_match("${output}" "Found BulletSoftBody: the environment's ${name}, ${prefix}, float32, float64 ")
  unset(ENV{${name}})

  refused("-D${name}=${WORK_DIR}/nowhere"
          MATCHES "was not found in ${name}, ${WORK_DIR}/nowhere: no [^ ]*btSoftBody.h in .*, and no library Bullet")
endforeach()

# The command line is nearer than the environment.
set(ENV{BULLET_ROOT} "${prefix}")
found("${other}" "-DBullet_ROOT=${other}")
unset(ENV{BULLET_ROOT})

# Bullet_DIR is the folder of Bullet's CMake files, wherever a distribution puts it; a search that failed says nothing.
foreach(folder IN ITEMS lib/cmake/bullet lib/x86_64-linux-gnu/cmake/bullet lib64/cmake/bullet share/bullet3)
  found("${prefix}" "-DBullet_DIR=${prefix}/${folder}")
endforeach()
found("${other}" "-DBullet_DIR=Bullet_DIR-NOTFOUND")

# A toolchain file that shuts out everything but its root does not shut out what was named.
set(only_the_root "-DCMAKE_FIND_ROOT_PATH=${WORK_DIR}/root" -DCMAKE_FIND_ROOT_PATH_MODE_INCLUDE=ONLY
                  -DCMAKE_FIND_ROOT_PATH_MODE_LIBRARY=ONLY -DCMAKE_FIND_ROOT_PATH_MODE_PACKAGE=ONLY)
found("${prefix}" "-DBULLET_ROOT=${prefix}" ${only_the_root})
# Without a name, the one in its root is found.
found("${WORK_DIR}/root/usr" ${only_the_root})
