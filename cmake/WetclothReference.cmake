# SPDX-License-Identifier: Zlib
# wetcloth_add_reference(<target> <header>...): the reference of these public headers, by Doxygen, where it is installed.
# Nothing else depends on it; the preset `docs` has it in build/docs/api.
function(wetcloth_add_reference target)
  find_program(WETCLOTH_DOXYGEN doxygen)
  mark_as_advanced(WETCLOTH_DOXYGEN)
  if(NOT WETCLOTH_DOXYGEN)
    return()
  endif()
  list(JOIN ARGN "\" \"" headers)
  set(output "${PROJECT_BINARY_DIR}/api")
  configure_file("${PROJECT_SOURCE_DIR}/cmake/Doxyfile.in" Doxyfile @ONLY)
  add_custom_target(
    ${target}
    COMMAND "${CMAKE_COMMAND}" -E rm -rf "${output}"
    COMMAND "${WETCLOTH_DOXYGEN}" "${CMAKE_CURRENT_BINARY_DIR}/Doxyfile"
    VERBATIM)
endfunction()
