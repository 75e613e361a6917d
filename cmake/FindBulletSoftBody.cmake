# SPDX-License-Identifier: Zlib
#[==[
FindBulletSoftBody: Bullet with soft bodies, in each precision that is there.

The Bullet package of Debian ships a BulletConfig.cmake with relative paths, no version and no targets, and
CMake's own FindBullet knows of one precision only; hence this module. It looks, in this order, at

1. the targets BulletSoftBody, BulletDynamics, BulletCollision and LinearMath of a parent build;
2. the prefix in BULLET_ROOT, a CMake or an environment variable, and then nowhere else: who names a prefix
   does not want to get another one silently;
3. the system (and CMAKE_PREFIX_PATH, toolchains and so on, as find_library does).

Components: float32, float64. Without components, one of them is enough.

Targets: Bullet::SoftBody          btScalar is float
         Bullet::SoftBody-float64  btScalar is double, BT_USE_DOUBLE_PRECISION is defined

Variables: BulletSoftBody_FOUND, BulletSoftBody_VERSION, BulletSoftBody_float32_FOUND,
           BulletSoftBody_float64_FOUND, BulletSoftBody_SOURCE (a phrase that says where it was found)

Linking both targets into one target is an error when CMake generates: Bullet's symbols do not all differ by
precision, so such a program may link and then crash.
#]==]

include(FindPackageHandleStandardArgs)

# Users before what they use, as static libraries need it.
set(_bullet_libraries BulletSoftBody BulletDynamics BulletCollision LinearMath)

# A program that only links with the libraries of the precision it is compiled for: setTotalMass is compiled
# into the library and the scalar is a part of its mangled name. The world's own symbols are the same in both.
set(_bullet_link_test
    [==[
#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

int main()
{
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btSoftRigidDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  btSoftBody body(&world.getWorldInfo());
  body.setTotalMass(btScalar(1), false);
  return world.getNumCollisionObjects();
}
]==])

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
               BULLET_VERSION "${version}")
endfunction()

# BT_BULLET_VERSION 324 -> 3.24; empty when the header cannot be read now
function(_bullet_read_version include_dir result)
  set(version "")
  set(header "${include_dir}/LinearMath/btScalar.h")
  if(EXISTS "${header}")
    file(STRINGS "${header}" line REGEX "^#define BT_BULLET_VERSION +[0-9]+")
    if(line MATCHES "BT_BULLET_VERSION +([0-9]+)([0-9][0-9])")
      set(version "${CMAKE_MATCH_1}.${CMAKE_MATCH_2}")
    endif()
  endif()
  set(${result} "${version}" PARENT_SCOPE)
endfunction()

# Does the link test pass with these libraries (paths or imported targets)? Remembered per set of arguments, so
# that a later configure is quick and a changed one is tried anew. On failure the caller's
# _bullet_link_output has the output.
function(_bullet_links precision include_dirs libraries result)
  string(MD5 key "${precision} ${include_dirs} ${libraries} ${CMAKE_CXX_COMPILER} ${_bullet_link_test}")
  set(passed "_BULLET_LINKS_${key}")
  # A failure is not remembered: the user may be mending that installation.
  if(NOT ${passed})
    unset(${passed} CACHE)
    set(source "${CMAKE_BINARY_DIR}/CMakeFiles/BulletSoftBodyLinkTest.cpp")
    file(WRITE "${source}" "${_bullet_link_test}")
    set(definitions "")
    if(precision STREQUAL "float64")
      set(definitions COMPILE_DEFINITIONS -DBT_USE_DOUBLE_PRECISION)
    endif()
    try_compile(
      ${passed} "${CMAKE_BINARY_DIR}/CMakeFiles/BulletSoftBodyLinkTest" "${source}"
      CMAKE_FLAGS "-DINCLUDE_DIRECTORIES=${include_dirs}"
      ${definitions}
      LINK_LIBRARIES ${libraries}
      OUTPUT_VARIABLE output)
    if(NOT ${passed})
      # find_package_handle_standard_args takes a semicolon in its message for the end of it.
      string(REPLACE ";" "," output "${output}")
      set(_bullet_link_output "${output}" PARENT_SCOPE)
    endif()
    mark_as_advanced(${passed})
  endif()
  set(${result} "${${passed}}" PARENT_SCOPE)
endfunction()

# 1. A parent build's own targets -----------------------------------------------------------------------------

# Bullet's own CMake files give its targets no interface: include directories and definitions are set on
# directories, so both are read there.
function(_bullet_from_targets)
  set(include_dirs "")
  set(definitions "")
  set(all_imported TRUE)
  foreach(library IN LISTS _bullet_libraries)
    get_target_property(aliased ${library} ALIASED_TARGET)
    if(aliased)
      set(library ${aliased})
    endif()
    get_target_property(imported ${library} IMPORTED)
    foreach(property IN ITEMS INTERFACE_COMPILE_DEFINITIONS COMPILE_DEFINITIONS)
      get_target_property(value ${library} ${property})
      if(value)
        list(APPEND definitions ${value})
      endif()
    endforeach()
    get_target_property(value ${library} INTERFACE_INCLUDE_DIRECTORIES)
    if(value)
      list(APPEND include_dirs ${value})
    endif()
    if(NOT imported)
      set(all_imported FALSE)
      get_target_property(directory ${library} SOURCE_DIR)
      get_property(value DIRECTORY "${directory}" PROPERTY COMPILE_DEFINITIONS)
      list(APPEND definitions ${value})
      get_filename_component(parent "${directory}" DIRECTORY)
      if(EXISTS "${parent}/LinearMath/btScalar.h")
        list(APPEND include_dirs "${parent}")
      endif()
    endif()
  endforeach()
  list(REMOVE_DUPLICATES include_dirs)
  # Bullet's own switches only: they change its headers, and a user has to see the same headers.
  list(TRANSFORM definitions REPLACE "^-D" "")
  list(FILTER definitions INCLUDE REGEX "^BT_")
  list(REMOVE_DUPLICATES definitions)

  set(version "")
  foreach(directory IN LISTS include_dirs)
    string(REGEX REPLACE "^\\$<BUILD_INTERFACE:(.*)>$" "\\1" directory "${directory}")
    if(NOT version)
      _bullet_read_version("${directory}" version)
    endif()
  endforeach()

  set(precision float32)
  if("BT_USE_DOUBLE_PRECISION" IN_LIST definitions OR "${definitions}" MATCHES "BT_USE_DOUBLE_PRECISION=")
    set(precision float64)
  elseif(all_imported)
    # Found, not built here: what the files are counts.
    _bullet_links(float32 "${include_dirs}" "${_bullet_libraries}" links)
    if(NOT links)
      _bullet_links(float64 "${include_dirs}" "${_bullet_libraries}" links)
      if(links)
        set(precision float64)
      endif()
    endif()
  elseif(USE_DOUBLE_PRECISION)
    set(precision float64)
  endif()

  _bullet_target(${precision} target)
  if(NOT TARGET ${target})
    _bullet_add_target(
      ${precision} "${version}"
      LIBRARIES ${_bullet_libraries}
      INCLUDES ${include_dirs}
      DEFINITIONS ${definitions})
  endif()
endfunction()

# 2. and 3. A prefix, or the system ---------------------------------------------------------------------------

# The libraries <name><suffix> under lib/<folder>, or an empty list unless all are there.
function(_bullet_find_libraries root suffix folder result)
  set(found "")
  foreach(library IN LISTS _bullet_libraries)
    if(root)
      set(where PATHS "${root}" NO_DEFAULT_PATH
                PATH_SUFFIXES lib/${CMAKE_LIBRARY_ARCHITECTURE}/${folder} lib/${folder} lib64/${folder} ${folder})
    elseif(folder)
      set(where PATH_SUFFIXES ${folder})
    else()
      set(where "")
    endif()
    set(path "path-NOTFOUND")
    find_library(path NAMES ${library}${suffix} ${where} NO_CACHE)
    if(NOT path)
      set(${result} "" PARENT_SCOPE)
      return()
    endif()
    list(APPEND found "${path}")
  endforeach()
  set(${result} "${found}" PARENT_SCOPE)
endfunction()

# Sets _bullet_problem in the caller when something is there but does not work.
function(_bullet_from_files root)
  if(root)
    set(where PATHS "${root}" NO_DEFAULT_PATH PATH_SUFFIXES include/bullet include src)
  else()
    set(where PATH_SUFFIXES bullet)
  endif()
  set(include_dir "include_dir-NOTFOUND")
  find_path(include_dir NAMES BulletSoftBody/btSoftBody.h ${where} NO_CACHE)
  if(NOT include_dir)
    return()
  endif()
  # find_path leaves a slash behind a path suffix.
  string(REGEX REPLACE "/$" "" include_dir "${include_dir}")
  _bullet_read_version("${include_dir}" version)

  # Debian marks the double libraries by a suffix, Homebrew by a folder, and a build of one's own not at all:
  # there only the link test tells.
  set(places_float32 "||" "|bullet/single|")
  set(places_float64 "-float64||" "|bullet/double|" "||")
  set(problem "")
  foreach(precision IN ITEMS float32 float64)
    _bullet_target(${precision} target)
    foreach(place IN LISTS places_${precision})
      if(TARGET ${target})
        break()
      endif()
      string(REGEX MATCH "^([^|]*)\\|([^|]*)\\|$" place "${place}")
      _bullet_find_libraries("${root}" "${CMAKE_MATCH_1}" "${CMAKE_MATCH_2}" libraries)
      if(libraries)
        _bullet_links(${precision} "${include_dir}" "${libraries}" links)
        if(links)
          _bullet_add_target(
            ${precision} "${version}"
            LIBRARIES ${libraries}
            INCLUDES "${include_dir}")
        else()
          list(GET libraries 0 first)
          set(problem "A test program does not link with ${first}:\n${_bullet_link_output}\n")
        endif()
      endif()
    endforeach()
  endforeach()
  set(_bullet_problem "${problem}" PARENT_SCOPE)
endfunction()

# -------------------------------------------------------------------------------------------------------------

set(_bullet_root "${BULLET_ROOT}")
if(NOT _bullet_root)
  set(_bullet_root "$ENV{BULLET_ROOT}")
endif()
set(_bullet_problem "")

# Both may exist already, from an earlier call: then they stay as they are.
if(TARGET BulletSoftBody
   AND TARGET BulletDynamics
   AND TARGET BulletCollision
   AND TARGET LinearMath)
  set(BulletSoftBody_SOURCE "targets of the parent build")
  if(NOT TARGET Bullet::SoftBody AND NOT TARGET Bullet::SoftBody-float64)
    _bullet_from_targets()
  endif()
elseif(_bullet_root)
  get_filename_component(_bullet_root "${_bullet_root}" ABSOLUTE BASE_DIR "${CMAKE_SOURCE_DIR}")
  set(BulletSoftBody_SOURCE "BULLET_ROOT, ${_bullet_root}")
  _bullet_from_files("${_bullet_root}")
else()
  set(BulletSoftBody_SOURCE "the system")
  _bullet_from_files("")
endif()

set(BulletSoftBody_VERSION "")
set(_bullet_found_precisions "")
foreach(_bullet_precision IN ITEMS float32 float64)
  _bullet_target(${_bullet_precision} _bullet_target_name)
  set(BulletSoftBody_${_bullet_precision}_FOUND FALSE)
  if(TARGET ${_bullet_target_name})
    set(BulletSoftBody_${_bullet_precision}_FOUND TRUE)
    list(APPEND _bullet_found_precisions ${_bullet_precision})
    get_target_property(BulletSoftBody_VERSION ${_bullet_target_name} BULLET_VERSION)
  endif()
endforeach()
string(REPLACE ";" ", " _bullet_found_precisions "${_bullet_found_precisions}")

if(_bullet_found_precisions)
  set(_bullet_message "Bullet in ${BulletSoftBody_SOURCE} is of another version or precision than asked for.\n")
elseif(_bullet_problem)
  set(_bullet_message "Bullet in ${BulletSoftBody_SOURCE} does not work.\n${_bullet_problem}")
else()
  set(_bullet_message "Bullet with soft bodies was not found in ${BulletSoftBody_SOURCE}.\n")
endif()
string(
  APPEND
  _bullet_message
  "Install it:\n"
  "  Debian, Ubuntu: apt install libbullet-dev libeigen3-dev\n"
  "  Homebrew:       brew install bullet eigen\n"
  "  vcpkg:          vcpkg install bullet3 eigen3\n"
  "  Conan:          conan install --requires=bullet3/3.25 --requires=eigen/3.4.0\n"
  "or say where it is: cmake -DBULLET_ROOT=<prefix>, a prefix that has include/bullet and lib.\n")

# What is shown as the place of the package, and what counts as missing.
set(BulletSoftBody_FOUND_IN "")
if(_bullet_found_precisions)
  set(BulletSoftBody_FOUND_IN "${BulletSoftBody_SOURCE}, ${_bullet_found_precisions}")
endif()

find_package_handle_standard_args(
  BulletSoftBody
  REQUIRED_VARS BulletSoftBody_FOUND_IN
  VERSION_VAR BulletSoftBody_VERSION
  HANDLE_COMPONENTS
  FAIL_MESSAGE "${_bullet_message}")

foreach(_bullet_name IN ITEMS root problem libraries link_test precision target_name found_precisions message)
  unset(_bullet_${_bullet_name})
endforeach()
unset(_bullet_name)
