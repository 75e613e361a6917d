# SPDX-License-Identifier: Zlib
# wetcloth_install_pkg_config(<target> <description> <component> [REQUIRES <name>] [BULLET <target>])
#
# <target>.pc, for builds without CMake. It may be moved with its tree; Bullet stays where it was found.
function(wetcloth_install_pkg_config target description component)
  cmake_parse_arguments(PARSE_ARGV 3 arg "" "REQUIRES;BULLET" "")
  set(place "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
  file(RELATIVE_PATH to_prefix "/${place}" "/")

  set(cflags "-I\${includedir}")
  set(libs "-L\${libdir} -l${target}")
  if(arg_BULLET)
    get_target_property(folders ${arg_BULLET} INTERFACE_INCLUDE_DIRECTORIES)
    get_target_property(definitions ${arg_BULLET} INTERFACE_COMPILE_DEFINITIONS)
    get_target_property(libraries ${arg_BULLET} INTERFACE_LINK_LIBRARIES)
    list(TRANSFORM folders PREPEND " -I")
    list(TRANSFORM definitions PREPEND " -D")
    # Paths stand as they are; names, of a parent's targets, become options.
    list(TRANSFORM libraries PREPEND "-l" REGEX "^[^/-]")
    list(JOIN libraries " " libraries)
    string(APPEND cflags ${folders} ${definitions})
    string(APPEND libs " ${libraries}")
  endif()
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "SHARED_LIBRARY")
    string(APPEND cflags " -DWETCLOTH_SHARED")
  endif()

  file(CONFIGURE OUTPUT "${CMAKE_CURRENT_BINARY_DIR}/${target}.pc" CONTENT "prefix=\${pcfiledir}/${to_prefix}
libdir=\${prefix}/${CMAKE_INSTALL_LIBDIR}
includedir=\${prefix}/${CMAKE_INSTALL_INCLUDEDIR}

Name: ${target}
Description: ${description}
Version: ${PROJECT_VERSION}
Requires: ${arg_REQUIRES}
Cflags: ${cflags}
Libs: ${libs}
" @ONLY)
  install(
    FILES "${CMAKE_CURRENT_BINARY_DIR}/${target}.pc"
    DESTINATION "${place}"
    COMPONENT ${component})
endfunction()
