# SPDX-License-Identifier: Zlib
# The shared libraries: built, installed and moved, they find each other, and what the headers say is what they show.
include("${CMAKE_CURRENT_LIST_DIR}/package_test.cmake")
use_quick_compiler()

list(GET PRECISIONS 0 precision)
set(build "${WORK_DIR}/library")
set(prefix "${WORK_DIR}/prefix")
file(REMOVE_RECURSE "${prefix}" "${prefix}-moved")
configure(
  "${SOURCE_DIR}" "${build}" -DBUILD_SHARED_LIBS=ON "-DWETCLOTH_BUILD_PRECISIONS=${precision}"
  -DWETCLOTH_FILES_PER_OBJECT=200 -DWETCLOTH_BUILD_TESTS=OFF -DWETCLOTH_BUILD_EXAMPLES=OFF -DWETCLOTH_BUILD_COMMAND=OFF
  -DWETCLOTH_EXACT_COLLISION=OFF)
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
file(GLOB libraries "${prefix}-moved/lib*/libbullet_wetcloth.so" "${prefix}-moved/lib*/*/libbullet_wetcloth.so")
list(GET libraries 0 library)
run("${NM}" -DC --defined-only "${library}")
must_match("${output}" "wetcloth::${precision}::WetClothWorld::save")
if(output MATCHES "SpringSolver::solve|transferSoftBody|Eigen::")
  message(FATAL_ERROR "${library} shows ${CMAKE_MATCH_0}")
endif()
