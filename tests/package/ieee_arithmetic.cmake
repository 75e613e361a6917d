# SPDX-License-Identifier: Zlib
# The library does not compile with -ffast-math, nor with what a compiler lets see of its parts; with what we use it does.
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
