# SPDX-License-Identifier: Zlib
# wetcloth_embed_files(<target> <unit> <file>...)
#
# Compiles files into the target: each is a std::string_view in namespace `embedded`, named as the file with _ for
# every other character, and declared in the header <unit>.h.
function(wetcloth_embed_files target unit)
  set(folder "${CMAKE_CURRENT_BINARY_DIR}/embedded")
  set(header "#pragma once\n\n#include <string_view>\n\nnamespace embedded {\n")
  set(source "#include \"${unit}.h\"\n\nnamespace embedded {\nnamespace {\n")
  set(views "")
  foreach(file IN LISTS ARGN)
    get_filename_component(path "${file}" ABSOLUTE)
    get_filename_component(name "${file}" NAME)
    string(MAKE_C_IDENTIFIER "${name}" name)
    file(READ "${path}" bytes HEX)
    string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
    string(APPEND header "extern const std::string_view ${name};\n")
    string(APPEND source "const unsigned char ${name}_bytes[] = {${bytes}};\n")
    string(APPEND views "const std::string_view ${name}(reinterpret_cast<const char*>(${name}_bytes), "
                        "sizeof ${name}_bytes);\n")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${path}")
  endforeach()
  file(CONFIGURE OUTPUT "${folder}/${unit}.h" CONTENT "${header}}  // namespace embedded\n" @ONLY)
  file(CONFIGURE OUTPUT "${folder}/${unit}.cpp" CONTENT "${source}}  // namespace\n${views}}  // namespace embedded\n"
       @ONLY)
  target_sources(${target} PRIVATE "${folder}/${unit}.cpp")
  target_include_directories(${target} PRIVATE "${folder}")
endfunction()
