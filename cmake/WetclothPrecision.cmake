# SPDX-License-Identifier: Zlib
# Everything here is built once per precision of btScalar that is wanted and that Bullet was found in.
# WETCLOTH_PRECISIONS lists them; target names carry a suffix for all but float32, as Debian names Bullet's libraries.
set(WETCLOTH_BUILD_PRECISIONS "float32;float64" CACHE STRING "Precisions of btScalar to build, where Bullet has them")

macro(wetcloth_set_precisions)
  set(WETCLOTH_PRECISIONS "")
  foreach(precision IN ITEMS float32 float64)
    if(NOT precision IN_LIST WETCLOTH_BUILD_PRECISIONS)
      message(STATUS "${precision} is not built: WETCLOTH_BUILD_PRECISIONS does not have it")
    elseif(BulletSoftBody_${precision}_FOUND)
      list(APPEND WETCLOTH_PRECISIONS ${precision})
    else()
      message(STATUS "Bullet was not found in ${precision}: that precision of bullet_wetcloth is not built")
    endif()
  endforeach()
  if(NOT WETCLOTH_PRECISIONS)
    message(FATAL_ERROR "WETCLOTH_BUILD_PRECISIONS = \"${WETCLOTH_BUILD_PRECISIONS}\": Bullet is there in none of these; "
                        "must be float32, float64 or both")
  endif()
endmacro()

# "" for float32, "-float64" for float64
function(wetcloth_precision_suffix precision result)
  if(precision STREQUAL "float32")
    set(${result} "" PARENT_SCOPE)
  else()
    set(${result} "-${precision}" PARENT_SCOPE)
  endif()
endfunction()

# wetcloth_add_program(<target> <precision> <source>...): a program of this tree on the library.
function(wetcloth_add_program target precision)
  wetcloth_precision_suffix(${precision} suffix)
  add_executable(${target} ${ARGN})
  target_link_libraries(${target} PRIVATE bullet_wetcloth::bullet_wetcloth${suffix})
  wetcloth_compile_options(${target})
endfunction()
