# SPDX-License-Identifier: Zlib
# A Bullet that was built without RTTI has no type information of its classes: the libraries ask for none.
include("${CMAKE_CURRENT_LIST_DIR}/package_test.cmake")

foreach(precision IN LISTS PRECISIONS)
  run("${NM}" -C --undefined-only "${WETCLOTH_LIBRARY_${precision}}")
  string(REGEX MATCHALL "typeinfo for bt[A-Za-z0-9_]+" asked "${output}")
  list(REMOVE_DUPLICATES asked)
  # Whoever includes btSoftBody.h asks for this one: btMultiBodyLinkCollider.h defines its class's first virtual function
  # inline, outside the class. -fno-rtti for the program helps.
  list(REMOVE_ITEM asked "typeinfo for btCollisionObject")
  # ClothSolver's own typeinfo asks for its base's, only where CMake has found that this Bullet has it.
  list(REMOVE_ITEM asked "typeinfo for btDefaultSoftBodySolver")
  if(asked)
    message(FATAL_ERROR "${WETCLOTH_LIBRARY_${precision}} asks for ${asked}")
  endif()
endforeach()
