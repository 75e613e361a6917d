# SPDX-License-Identifier: Zlib
# The library does not compile with -ffast-math nor with a part of it: its sources refuse what a compiler lets see, and CMake
# all of them. With what we use it compiles.
include("${CMAKE_CURRENT_LIST_DIR}/package_test.cmake")

foreach(compiler IN ITEMS "${CXX_COMPILER}" ${OTHER_COMPILERS})
  set(compile "${compiler}" -fsyntax-only -O2 -x c++ "${SOURCE_DIR}/bullet_wetcloth/IeeeArithmetic.h")
  run(${compile} -fno-math-errno -fno-trapping-math -ffp-contract=off)
  set(flags -ffast-math -ffinite-math-only)
  run("${compiler}" --version)
  if(NOT output MATCHES "clang")
    list(APPEND flags -funsafe-math-optimizations -freciprocal-math -fno-signed-zeros)
  endif()
  foreach(flag IN LISTS flags)
    must_fail(${compile} ${flag} MATCHES "rests on IEEE arithmetic")
  endforeach()
endforeach()

foreach(flag IN ITEMS -ffast-math -ffinite-math-only -funsafe-math-optimizations -fassociative-math -freciprocal-math
                      -fno-signed-zeros -Ofast)
  configure_fails("${SOURCE_DIR}" "${WORK_DIR}/build" "-DCMAKE_CXX_FLAGS=-g ${flag} -Wall"
                  MATCHES "${flag} in CMAKE_CXX_FLAGS" "rests on IEEE arithmetic")
endforeach()
