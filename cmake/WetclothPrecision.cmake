# SPDX-License-Identifier: Zlib
# Everything here is built once per precision of btScalar that Bullet was found in. WETCLOTH_PRECISIONS lists
# them; target names carry a suffix for all but float32, as Debian names Bullet's libraries.

macro(wetcloth_set_precisions)
  set(WETCLOTH_PRECISIONS "")
  foreach(precision IN ITEMS float32 float64)
    if(BulletSoftBody_${precision}_FOUND)
      list(APPEND WETCLOTH_PRECISIONS ${precision})
    else()
      message(STATUS "Bullet was not found in ${precision}: that precision of bullet_wetcloth is not built")
    endif()
  endforeach()
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
