# SPDX-License-Identifier: Zlib
# The shared libraries: built, installed and moved, they find each other, and what the headers say is what they show.
include("${CMAKE_CURRENT_LIST_DIR}/package_test.cmake")
use_quick_compiler()

list(GET PRECISIONS -1 precision)
precision_suffix(${precision} suffix)
set(build "${WORK_DIR}/library")
set(prefix "${WORK_DIR}/prefix")
file(REMOVE_RECURSE "${build}" "${prefix}" "${prefix}-moved")

# The objects of the library are those of this build, which has compiled them for it. All else of a shared library is
# done here.
set(launcher "${CXX_COMPILER_LAUNCHER}")
if(OBJECTS_FOR_SHARED)
  file(CONFIGURE OUTPUT "${WORK_DIR}/take_object" @ONLY CONTENT [[#!/bin/sh
# COMPILER OPTION... -o OBJECT OPTION...
for word; do
  if [ "$option" = -o ]; then object=$word; fi
  option=$word
done
case $object in
  */@OBJECTS_FOR_SHARED@.dir/*) cp "@BUILD_DIR@/$object" "$object" ;;
  *) exec @launcher@ "$@" ;;
esac
]])
  file(CHMOD "${WORK_DIR}/take_object" PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
  set(CXX_COMPILER_LAUNCHER "${WORK_DIR}/take_object")
endif()
configure(
  "${SOURCE_DIR}" "${build}" -DBUILD_SHARED_LIBS=ON "-DWETCLOTH_BUILD_PRECISIONS=${precision}"
  "-DWETCLOTH_FILES_PER_OBJECT=${FILES_PER_OBJECT}" -DWETCLOTH_BUILD_TESTS=OFF -DWETCLOTH_BUILD_EXAMPLES=OFF
  -DWETCLOTH_BUILD_COMMAND=OFF -DWETCLOTH_EXACT_COLLISION=OFF)
set(CXX_COMPILER_LAUNCHER "${launcher}")
run("${CMAKE_COMMAND}" --build "${build}" --parallel 1)
run("${CMAKE_COMMAND}" --install "${build}" --prefix "${prefix}")
file(RENAME "${prefix}" "${prefix}-moved")

set(user "${WORK_DIR}/user")
configure("${CMAKE_CURRENT_LIST_DIR}/consumer" "${user}" -DMETHOD=find_package "-DCMAKE_PREFIX_PATH=${prefix}-moved"
          "-DPRECISIONS=${precision}")
run("${CMAKE_COMMAND}" --build "${user}" --parallel 2)
run("${user}/app-${precision}")
run("${user}/host" "${user}/plugin.so")

# What is inside stays there, so that it may change.
set(name "libbullet_wetcloth${suffix}.so")
file(GLOB libraries "${prefix}-moved/lib*/${name}" "${prefix}-moved/lib*/*/${name}")
list(GET libraries 0 library)
run("${NM}" -DC --defined-only "${library}")
must_match("${output}" "wetcloth::${precision}::WetClothWorld::save")
if(output MATCHES "SpringSolver::solve|transferSoftBody|Eigen::")
  message(FATAL_ERROR "${library} shows ${CMAKE_MATCH_0}")
endif()
