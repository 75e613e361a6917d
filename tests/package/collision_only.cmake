# SPDX-License-Identifier: Zlib
# Who wants the collision checks alone needs no Bullet: to build and install them, to use what others installed.
include("${CMAKE_CURRENT_LIST_DIR}/package_test.cmake")

set(no_bullet "-DBULLET_ROOT=${WORK_DIR}/nowhere")
set(consumer "${CMAKE_CURRENT_LIST_DIR}/consumer")
configure("${consumer}" "${WORK_DIR}/full" -DMETHOD=find_package "-DCMAKE_PREFIX_PATH=${INSTALLED}"
          -DCOMPONENTS=collision ${no_bullet})
run("${CMAKE_COMMAND}" --build "${WORK_DIR}/full")
run("${WORK_DIR}/full/app-collision")

set(build "${WORK_DIR}/library")
set(prefix "${WORK_DIR}/prefix")
file(REMOVE_RECURSE "${prefix}")
# Compiled as in the test `shared`, so that the compiler cache has it.
use_quick_compiler()
configure("${SOURCE_DIR}" "${build}" -DWETCLOTH_COLLISION_ONLY=ON -DBUILD_SHARED_LIBS=ON -DWETCLOTH_BUILD_TESTS=OFF
          -DWETCLOTH_EXACT_COLLISION=OFF -DWETCLOTH_FILES_PER_OBJECT=100 ${no_bullet})
run("${CMAKE_COMMAND}" --build "${build}" --parallel 2)
run("${CMAKE_COMMAND}" --install "${build}" --prefix "${prefix}")
configure("${consumer}" "${WORK_DIR}/alone" -DMETHOD=find_package "-DCMAKE_PREFIX_PATH=${prefix}"
          -DCOMPONENTS=collision ${no_bullet})
run("${CMAKE_COMMAND}" --build "${WORK_DIR}/alone")
run("${WORK_DIR}/alone/app-collision")
configure_fails("${consumer}" "${WORK_DIR}/alone" -DMETHOD=find_package "-DCMAKE_PREFIX_PATH=${prefix}"
                -DCOMPONENTS=float32 MATCHES "bullet_wetcloth")
