# SPDX-License-Identifier: Zlib
# WETCLOTH_LIBRARY_OPTIONS: the tests spend their time in the libraries and in a few loops beside them, which are worth
# optimizing; what is compiled once and run once is not.
set(WETCLOTH_LIBRARY_OPTIONS "" CACHE STRING "Compiler options for the libraries, and for loops that the tests wait for")

# wetcloth_compile_as_library(<target> <source>...): such loops of a target. They are one object where files are compiled
# together, as CMake's unity build leaves out sources with options of their own.
function(wetcloth_compile_as_library target)
  set(sources ${ARGN})
  if(WETCLOTH_FILES_PER_OBJECT GREATER 1)
    set(together "")
    foreach(source IN LISTS sources)
      string(APPEND together "#include \"${CMAKE_CURRENT_SOURCE_DIR}/${source}\"\n")
    endforeach()
    set_source_files_properties(${sources} PROPERTIES HEADER_FILE_ONLY ON)
    set(sources "${CMAKE_CURRENT_BINARY_DIR}/${target}-loops.cpp")
    file(CONFIGURE OUTPUT "${sources}" CONTENT "${together}" @ONLY)
  endif()
  target_sources(${target} PRIVATE ${sources})
  # A precompiled header serves one level of optimization.
  set_source_files_properties(
    ${sources} PROPERTIES COMPILE_OPTIONS "${WETCLOTH_LIBRARY_OPTIONS}" SKIP_PRECOMPILE_HEADERS ON
                          SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# wetcloth_add_library(<target> EXPORT_NAME <name> EXPORTS <macro> <source>...)
#
# A library that is installed: static or shared, as BUILD_SHARED_LIBS says. Static ones fit into plugins, too. A shared
# one shows what its headers mark (Export.h), but all of it where there are tests, which look inside.
function(wetcloth_add_library target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "EXPORT_NAME;EXPORTS" "")
  add_library(${target} ${arg_UNPARSED_ARGUMENTS})
  add_library(bullet_wetcloth::${arg_EXPORT_NAME} ALIAS ${target})
  wetcloth_compile_options(${target})
  wetcloth_compile_together(${target})
  target_compile_options(${target} PRIVATE ${WETCLOTH_LIBRARY_OPTIONS})
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                              $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  # Its include directories, not the target: a static library would pass a linked target on, and users of an
  # installed bullet_wetcloth need no Eigen.
  target_include_directories(
    ${target} SYSTEM PRIVATE $<TARGET_PROPERTY:Eigen3::Eigen,INTERFACE_INCLUDE_DIRECTORIES>)

  # Before 1.0 a minor version may change the binary interface.
  set_target_properties(
    ${target}
    PROPERTIES EXPORT_NAME ${arg_EXPORT_NAME}
               DEFINE_SYMBOL ${arg_EXPORTS}
               POSITION_INDEPENDENT_CODE ON
               VERSION ${PROJECT_VERSION}
               SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  if(APPLE)
    set_target_properties(${target} PROPERTIES INSTALL_RPATH "@loader_path")
  else()
    set_target_properties(${target} PROPERTIES INSTALL_RPATH "$ORIGIN")
  endif()
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "SHARED_LIBRARY")
    target_compile_definitions(${target} PUBLIC WETCLOTH_SHARED)
  endif()
  if(NOT type STREQUAL "SHARED_LIBRARY" OR NOT WETCLOTH_BUILD_TESTS)
    set_target_properties(${target} PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  endif()
endfunction()

# wetcloth_compile_for_shared(<target>): a static library of whose objects a test makes a shared one, so that it need not
# compile them anew. Whoever links it into a plugin shows what its headers mark.
function(wetcloth_compile_for_shared target)
  target_compile_definitions(${target} PRIVATE WETCLOTH_SHARED)
  set_property(GLOBAL PROPERTY WETCLOTH_OBJECTS_FOR_SHARED ${target})
endfunction()

# wetcloth_install_library(<target> <export set> <component>): with its part of the CMake package
function(wetcloth_install_library target set component)
  install(
    TARGETS ${target}
    EXPORT ${set}
    COMPONENT ${component})
  install(
    EXPORT ${set}
    NAMESPACE bullet_wetcloth::
    DESTINATION "${WETCLOTH_PACKAGE_DIR}"
    COMPONENT ${component})
endfunction()

# wetcloth_install_headers(<header>...): relative to this folder, which is that below include/bullet_wetcloth, too
function(wetcloth_install_headers)
  file(RELATIVE_PATH place "${PROJECT_SOURCE_DIR}" "${CMAKE_CURRENT_SOURCE_DIR}")
  foreach(header IN LISTS ARGN)
    cmake_path(GET header PARENT_PATH folder)
    install(
      FILES ${header}
      DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/${place}/${folder}"
      COMPONENT library)
  endforeach()
endfunction()
