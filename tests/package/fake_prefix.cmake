# SPDX-License-Identifier: Zlib
# Prefixes with the small Bullet, and what FindBulletSoftBody makes of them.
include("${CMAKE_CURRENT_LIST_DIR}/package_test.cmake")

# Nothing is named until a test names it.
unset(ENV{BULLET_ROOT})
unset(ENV{CMAKE_PREFIX_PATH})

# A fresh <prefix>/include/bullet that says it is <version>, e.g. 324
function(fake_headers prefix version)
  file(REMOVE_RECURSE "${prefix}/include")
  set(include_dir "${prefix}/include/bullet")
  file(COPY "${CMAKE_CURRENT_LIST_DIR}/fake_bullet/FakeBullet.h" DESTINATION "${include_dir}")
  file(WRITE "${include_dir}/LinearMath/btScalar.h" "#define BT_BULLET_VERSION ${version}\n")
  foreach(header IN ITEMS BulletCollision/BroadphaseCollision/btQuantizedBvh.h BulletSoftBody/btSoftBody.h
                          BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h
                          BulletSoftBody/btSoftRigidDynamicsWorld.h LinearMath/btGeometryUtil.h
                          btBulletDynamicsCommon.h)
    file(WRITE "${include_dir}/${header}" "#include <FakeBullet.h>\n")
  endforeach()
endfunction()

# fake_libraries(<folder> <precision> <suffix> [<library>...]): all four by default; a suffix goes behind their names
function(fake_libraries folder precision suffix)
  set(names ${ARGN})
  if(NOT names)
    set(names BulletSoftBody BulletDynamics BulletCollision LinearMath)
  endif()
  foreach(name IN LISTS names)
    file(GLOB library "${WORK_DIR}/../fake_bullet/build/${precision}/*${name}.*")
    get_filename_component(file_name "${library}" NAME)
    string(REPLACE "${name}" "${name}${suffix}" file_name "${file_name}")
    file(MAKE_DIRECTORY "${folder}")
    file(COPY_FILE "${library}" "${folder}/${file_name}")
  endforeach()
endfunction()

# fake_prefix(<prefix> [<precision> [<suffix>]]): headers and libraries of 3.24
function(fake_prefix prefix)
  set(precision ${ARGV1})
  if(NOT precision)
    set(precision float32)
  endif()
  file(REMOVE_RECURSE "${prefix}")
  fake_headers("${prefix}" 324)
  fake_libraries("${prefix}/lib" ${precision} "${ARGV2}")
endfunction()

# search_in(<prefix>...): CMAKE_PREFIX_PATH, in this order
function(search_in)
  if(NOT CMAKE_HOST_WIN32)
    string(REPLACE ";" ":" ARGN "${ARGN}")
  endif()
  set(ENV{CMAKE_PREFIX_PATH} "${ARGN}")
endfunction()

# The command that configures the probe. The compiler is looked at once; all else that was said earlier is forgotten.
set(probe_build "${WORK_DIR}/build")
configure("${CMAKE_CURRENT_LIST_DIR}/bullet_probe" "${probe_build}" -DLOOK=OFF)
set(probe "${CMAKE_COMMAND}" "-UBULLET_*" "-UBullet*" "-UCMAKE_FIND_ROOT_*" "-UFIND_PACKAGE_MESSAGE_*"
          -UASKED -DLOOK=ON "${probe_build}")

# found(<prefix> <argument>...): everything comes from there; the output is left in the caller's `output`.
function(found prefix)
  run(${probe} ${ARGN})
  must_match("${output}" "Bullet::SoftBody[^ ]*: ${prefix}/include/bullet and ${prefix}/[^ ]*lib")
  set(output "${output}" PARENT_SCOPE)
endfunction()

# refused(<argument>... MATCHES <regex>...)
function(refused)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "" "MATCHES")
  must_fail(${probe} ${arg_UNPARSED_ARGUMENTS} MATCHES ${arg_MATCHES})
endfunction()
