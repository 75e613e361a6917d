# SPDX-License-Identifier: Zlib
#[==[
FindBulletSoftBody: Bullet with soft bodies, in each precision that is there.

The Bullet package of Debian ships a BulletConfig.cmake with relative paths, no version and no targets, and
CMake's own FindBullet knows of one precision only; hence this module. It looks, in this order, at

1. the targets BulletSoftBody, BulletDynamics, BulletCollision and LinearMath of a parent build;
2. the prefix in BULLET_ROOT, Bullet_ROOT, BULLET_ROOT_DIR or BulletSoftBody_ROOT, or the one around Bullet_DIR, the
   folder of Bullet's CMake files (CMake variables, then environment variables), and then nowhere else: who names a
   prefix does not want to get another one silently;
3. the first prefix of the system, CMAKE_PREFIX_PATH, toolchains and so on that has headers or libraries of Bullet.

Headers and libraries always come from one prefix. The precision is proven by a small program that links with them,
and the version by running it, where this machine can: Bullet's library knows which version it was compiled as.

Components: float32, float64. Without components, one of them is enough.

Targets: Bullet::SoftBody          btScalar is float
         Bullet::SoftBody-float64  btScalar is double, BT_USE_DOUBLE_PRECISION is defined

Variables: BulletSoftBody_FOUND, BulletSoftBody_VERSION, BulletSoftBody_float32_FOUND, BulletSoftBody_float64_FOUND,
           BulletSoftBody_SOURCE, a phrase that says where it was looked for,
           BulletSoftBody_PREFIX, empty for a parent's targets,
           BulletSoftBody_NOT_FOUND_MESSAGE

Linking both targets into one target is an error when CMake generates: Bullet's symbols do not all differ by
precision, so such a program may link and then crash.
#]==]

include(FindPackageHandleStandardArgs)
include("${CMAKE_CURRENT_LIST_DIR}/BulletSoftBodyProof.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/BulletSoftBodyFromParent.cmake")

# Users before what they use, as static libraries need it.
set(_bullet_libraries BulletSoftBody BulletDynamics BulletCollision LinearMath)

# <suffix>|<folder>| of the libraries. Debian marks the double ones by a suffix, Homebrew by a folder, and a build of
# one's own not at all: there only linking tells. The long suffixes are what Bullet's own build adds by configuration.
set(_bullet_places_any "||" "_RelWithDebugInfo||" "_MinsizeRel||" "_Debug||")
set(_bullet_places_float32 ${_bullet_places_any} "|bullet/single|")
set(_bullet_places_float64 "-float64||" "|bullet/double|" ${_bullet_places_any})

function(_bullet_target precision result)
  if(precision STREQUAL "float64")
    set(${result} Bullet::SoftBody-float64 PARENT_SCOPE)
  else()
    set(${result} Bullet::SoftBody PARENT_SCOPE)
  endif()
endfunction()

# _bullet_add_target(<precision> <version> LIBRARIES <l>... INCLUDES <dir>... DEFINITIONS <d>...)
function(_bullet_add_target precision version)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "" "LIBRARIES;INCLUDES;DEFINITIONS")
  if(precision STREQUAL "float64")
    list(APPEND arg_DEFINITIONS BT_USE_DOUBLE_PRECISION)
    list(REMOVE_DUPLICATES arg_DEFINITIONS)
  endif()

  _bullet_target(${precision} target)
  # GLOBAL: a parent that has us as a subdirectory links to this through our library.
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  set_target_properties(
    ${target}
    PROPERTIES INTERFACE_LINK_LIBRARIES "${arg_LIBRARIES}"
               INTERFACE_INCLUDE_DIRECTORIES "${arg_INCLUDES}"
               INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${arg_INCLUDES}"
               INTERFACE_COMPILE_DEFINITIONS "${arg_DEFINITIONS}"
               INTERFACE_BULLET_PRECISION ${precision}
               COMPATIBLE_INTERFACE_STRING BULLET_PRECISION
               BULLET_VERSION "${version}"
               BULLET_SOURCE "${BulletSoftBody_SOURCE}"
               BULLET_PREFIX "${BulletSoftBody_PREFIX}")
endfunction()

# 2. and 3. One prefix ----------------------------------------------------------------------------------------

# The prefix that the user names, and the name; both empty if none is named
function(_bullet_named_prefix prefix name)
  foreach(where IN ITEMS "" "the environment's ")
    foreach(variable IN ITEMS BULLET_ROOT Bullet_ROOT BULLET_ROOT_DIR BulletSoftBody_ROOT Bullet_DIR)
      set(value "${${variable}}")
      if(where)
        set(value "$ENV{${variable}}")
      endif()
      # Bullet_DIR-NOTFOUND is what a failed search leaves, and is false.
      if(value)
        get_filename_component(value "${value}" ABSOLUTE BASE_DIR "${CMAKE_SOURCE_DIR}")
        if(variable STREQUAL "Bullet_DIR" AND NOT EXISTS "${value}/include")
          string(REGEX REPLACE "/(lib[^/]*(/[^/]+)?|share)(/cmake)?/[^/]*$" "" value "${value}")
        endif()
        set(${prefix} "${value}" PARENT_SCOPE)
        set(${name} "${where}${variable}" PARENT_SCOPE)
        return()
      endif()
    endforeach()
  endforeach()
  set(${prefix} "" PARENT_SCOPE)
  set(${name} "" PARENT_SCOPE)
endfunction()

# The prefixes of the first headers and of the first libraries that CMake's own search meets: normally it is one.
function(_bullet_default_prefixes result)
  set(headers "headers-NOTFOUND")
  find_path(headers NAMES BulletSoftBody/btSoftBody.h PATH_SUFFIXES bullet NO_CACHE)
  set(names "")
  foreach(place IN LISTS _bullet_places_float32 _bullet_places_float64)
    string(REGEX REPLACE "\\|.*" "" suffix "${place}")
    list(APPEND names BulletSoftBody${suffix})
  endforeach()
  list(REMOVE_DUPLICATES names)
  set(library "library-NOTFOUND")
  find_library(library NAMES ${names} NAMES_PER_DIR PATH_SUFFIXES bullet/single bullet/double NO_CACHE)

  set(prefixes "")
  if(headers)
    # find_path leaves a slash behind a path suffix.
    string(REGEX REPLACE "/$" "" prefix "${headers}")
    string(REGEX REPLACE "(/include/bullet|/include|/src)$" "" prefix "${prefix}")
    list(APPEND prefixes "${prefix}")
  endif()
  if(library)
    get_filename_component(prefix "${library}" DIRECTORY)
    string(REGEX REPLACE "/lib[^/]*(/${CMAKE_LIBRARY_ARCHITECTURE})?(/bullet/(single|double))?$" "" prefix "${prefix}")
    # vcpkg keeps its debug libraries in a folder of the prefix.
    if(NOT EXISTS "${prefix}/include")
      string(REGEX REPLACE "/debug$" "" prefix "${prefix}")
    endif()
    list(APPEND prefixes "${prefix}")
  endif()
  list(REMOVE_DUPLICATES prefixes)
  set(${result} "${prefixes}" PARENT_SCOPE)
endfunction()

function(_bullet_find_headers prefix result)
  set(found "")
  foreach(folder IN ITEMS src include include/bullet)
    if(EXISTS "${prefix}/${folder}/BulletSoftBody/btSoftBody.h")
      set(found "${prefix}/${folder}")
    endif()
  endforeach()
  set(${result} "${found}" PARENT_SCOPE)
endfunction()

# The libraries of <prefix> in <place>, all of one folder, or nothing; then <missing> names one that is not there.
function(_bullet_find_libraries prefix place result missing)
  string(REGEX MATCH "^([^|]*)\\|([^|]*)\\|$" place "${place}")
  set(suffix "${CMAKE_MATCH_1}")
  set(folders "")
  foreach(folder IN ITEMS "lib/${CMAKE_LIBRARY_ARCHITECTURE}" lib lib64 debug/lib)
    list(APPEND folders "${prefix}/${folder}/${CMAKE_MATCH_2}")
  endforeach()
  set(found "")
  foreach(library IN LISTS _bullet_libraries)
    set(path "path-NOTFOUND")
    # The prefix is the user's word, and not to be looked for in a toolchain's root.
    find_library(path NAMES ${library}${suffix} PATHS ${folders} NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH NO_CACHE)
    if(NOT path)
      set(${result} "" PARENT_SCOPE)
      set(${missing} "${library}" PARENT_SCOPE)
      return()
    endif()
    get_filename_component(folders "${path}" DIRECTORY)
    list(APPEND found "${path}")
  endforeach()
  set(${result} "${found}" PARENT_SCOPE)
  set(${missing} "" PARENT_SCOPE)
endfunction()

# One line when half of the installation in <prefix> is missing, or all of it; else empty
function(_bullet_check_halves prefix problem)
  _bullet_find_headers("${prefix}" include_dir)
  set(absent BulletSoftBody)
  foreach(place IN LISTS _bullet_places_float32 _bullet_places_float64)
    _bullet_find_libraries("${prefix}" "${place}" libraries missing)
    if(absent AND NOT missing STREQUAL "BulletSoftBody")
      set(absent "${missing}")
    endif()
  endforeach()
  set(header "BulletSoftBody/btSoftBody.h in its include/bullet, include or src")
  set(library "library ${absent} in its lib, lib64 or lib/<architecture>")
  set(text "")
  if(absent STREQUAL "BulletSoftBody" AND NOT include_dir)
    set(text "Bullet with soft bodies was not found in ${BulletSoftBody_SOURCE}: no ${header}, and no ${library}.")
  elseif(NOT include_dir)
    set(text "Bullet in ${prefix} is incomplete: it has libraries, and no headers: no ${header}.")
  elseif(absent)
    set(text "Bullet in ${prefix} is incomplete: it has headers, and no ${library}.")
  endif()
  set(${problem} "${text}" PARENT_SCOPE)
endfunction()

# The target of <precision>, with the first libraries of <prefix> that prove to be of it
function(_bullet_add_precision precision prefix include_dir problem)
  set(text "")
  foreach(place IN LISTS _bullet_places_${precision})
    _bullet_find_libraries("${prefix}" "${place}" libraries missing)
    if(libraries)
      _bullet_prove(${precision} "${include_dir}" "${libraries}" version text)
      if(version)
        _bullet_add_target(
          ${precision} "${version}"
          LIBRARIES ${libraries}
          INCLUDES "${include_dir}")
        break()
      endif()
    endif()
  endforeach()
  set(${problem} "${text}" PARENT_SCOPE)
endfunction()

# Leaves a problem where no target could be made, and what is wrong with a precision as <problem>_<precision>.
function(_bullet_from_prefix prefix problem)
  _bullet_check_halves("${prefix}" text)
  if(NOT text)
    _bullet_find_headers("${prefix}" include_dir)
    _bullet_header_version("${include_dir}" version)
    _bullet_check_version("${version}" text)
  endif()
  if(NOT text)
    set(text "Bullet in ${BulletSoftBody_SOURCE} does not work.\n")
    foreach(precision IN ITEMS float32 float64)
      _bullet_add_precision(${precision} "${prefix}" "${include_dir}" why_not)
      set(${problem}_${precision} "${why_not}" PARENT_SCOPE)
      string(APPEND text "${why_not}\n")
    endforeach()
    if(TARGET Bullet::SoftBody OR TARGET Bullet::SoftBody-float64)
      set(text "")
    endif()
  endif()
  set(${problem} "${text}" PARENT_SCOPE)
endfunction()

# The one prefix of CMake's own search, or a problem. Where headers and libraries are first met in two prefixes, the
# one that comes first in the search is incomplete: then it is the problem.
function(_bullet_default_prefix prefix problem)
  _bullet_default_prefixes(candidates)
  set(text "")
  if(NOT candidates)
    set(text "Bullet with soft bodies was not found in the system: no BulletSoftBody/btSoftBody.h and no library \
BulletSoftBody in any prefix that CMake searches.")
  endif()
  foreach(candidate IN LISTS candidates)
    if(NOT text)
      _bullet_check_halves("${candidate}" text)
    endif()
  endforeach()
  string(REGEX REPLACE ";.*" "" first "${candidates}")
  set(${prefix} "${first}" PARENT_SCOPE)
  set(${problem} "${text}" PARENT_SCOPE)
endfunction()

# What was found ----------------------------------------------------------------------------------------------

# Sets the precisions' variables and those that the targets know.
macro(_bullet_set_results)
  foreach(_bullet_precision IN ITEMS float32 float64)
    _bullet_target(${_bullet_precision} _bullet_target_name)
    set(BulletSoftBody_${_bullet_precision}_FOUND FALSE)
    if(TARGET ${_bullet_target_name})
      set(BulletSoftBody_${_bullet_precision}_FOUND TRUE)
      foreach(_bullet_name IN ITEMS VERSION SOURCE PREFIX)
        get_target_property(BulletSoftBody_${_bullet_name} ${_bullet_target_name} BULLET_${_bullet_name})
      endforeach()
    endif()
  endforeach()
endmacro()

# A component that is asked for and not there is a problem, too.
macro(_bullet_check_components)
  foreach(_bullet_precision IN LISTS BulletSoftBody_FIND_COMPONENTS)
    if(BulletSoftBody_FIND_REQUIRED_${_bullet_precision} AND NOT BulletSoftBody_${_bullet_precision}_FOUND
       AND NOT _bullet_problem)
      set(_bullet_problem "Bullet in ${BulletSoftBody_SOURCE} has no libraries of component ${_bullet_precision}. \
${_bullet_problem_${_bullet_precision}}")
    endif()
  endforeach()
endmacro()

set(_bullet_advice
    "Install it:
  Debian 11, Ubuntu 22.04 or newer: apt install libbullet-dev libeigen3-dev
  Homebrew:                         brew install bullet eigen
  vcpkg:                            vcpkg install bullet3 eigen3
  Conan:                            conan install --requires=bullet3/3.25 --requires=eigen/3.4.0
or say where it is: cmake -DBULLET_ROOT=<prefix>, a prefix that has include/bullet and lib.
")
# A Bullet that is there and too old is not mended by what a system has to install, which may be that one.
set(_bullet_advice_on_version "Say where another one is: cmake -DBULLET_ROOT=<prefix>, a prefix that has include/bullet and lib.
")
set(_bullet_problem "")
set(BulletSoftBody_PREFIX "")
set(BulletSoftBody_VERSION "")
_bullet_named_prefix(BulletSoftBody_PREFIX _bullet_name)

# Targets of an earlier call stay as they are: two calls that look in two places must not give one of each.
if(TARGET Bullet::SoftBody OR TARGET Bullet::SoftBody-float64)
  _bullet_set_results()
  _bullet_check_version("${BulletSoftBody_VERSION}" _bullet_problem)
elseif(
  TARGET BulletSoftBody
  AND TARGET BulletDynamics
  AND TARGET BulletCollision
  AND TARGET LinearMath)
  set(BulletSoftBody_SOURCE "targets of the parent build")
  set(BulletSoftBody_PREFIX "")
  _bullet_from_targets(_bullet_problem)
else()
  if(BulletSoftBody_PREFIX)
    set(BulletSoftBody_SOURCE "${_bullet_name}, ${BulletSoftBody_PREFIX}")
  else()
    set(BulletSoftBody_SOURCE "the system")
    _bullet_default_prefix(BulletSoftBody_PREFIX _bullet_problem)
    if(BulletSoftBody_PREFIX)
      string(APPEND BulletSoftBody_SOURCE ", ${BulletSoftBody_PREFIX}")
    endif()
  endif()
  if(NOT _bullet_problem)
    _bullet_from_prefix("${BulletSoftBody_PREFIX}" _bullet_problem)
  endif()
endif()
_bullet_set_results()
_bullet_check_components()

set(BulletSoftBody_NOT_FOUND_MESSAGE "${_bullet_problem}")
if(_bullet_problem)
  set(BulletSoftBody_FOUND FALSE)
  if(_bullet_problem MATCHES " is version [0-9.]+, and it has to be ")
    set(_bullet_advice "${_bullet_advice_on_version}")
  endif()
  if(BulletSoftBody_FIND_REQUIRED)
    message(FATAL_ERROR "${_bullet_problem}\n${_bullet_advice}")
  elseif(NOT BulletSoftBody_FIND_QUIETLY)
    message(STATUS "${_bullet_problem}")
  endif()
else()
  # What is shown as the place of the package
  set(_bullet_found_in "${BulletSoftBody_SOURCE}")
  foreach(_bullet_precision IN ITEMS float32 float64)
    if(BulletSoftBody_${_bullet_precision}_FOUND)
      string(APPEND _bullet_found_in ", ${_bullet_precision}")
    endif()
  endforeach()
  find_package_handle_standard_args(
    BulletSoftBody
    REQUIRED_VARS _bullet_found_in
    VERSION_VAR BulletSoftBody_VERSION
    HANDLE_COMPONENTS)
endif()

foreach(_bullet_name IN ITEMS libraries program problem advice advice_on_version precision target_name found_in)
  unset(_bullet_${_bullet_name})
endforeach()
unset(_bullet_name)
