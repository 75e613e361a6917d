# SPDX-License-Identifier: Zlib
# wetcloth_require(<package> FOR <part> OPTION <option> DEBIAN <n> HOMEBREW <n> VCPKG <n> CONAN <n>)
#
# find_package(<package>) whose error says what to install, or which option does without.
function(wetcloth_require package)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "FOR;OPTION;DEBIAN;HOMEBREW;VCPKG;CONAN" "")
  find_package(${package} QUIET)
  if(${package}_FOUND)
    return()
  endif()

  set(without "")
  if(arg_OPTION)
    set(without "\n  or do without: cmake -D${arg_OPTION}=OFF")
  endif()
  message(
    FATAL_ERROR
      "${package} was not found; ${arg_FOR} needs it. Install it:\n"
      "  Debian, Ubuntu: apt install ${arg_DEBIAN}\n"
      "  Homebrew:       brew install ${arg_HOMEBREW}\n"
      "  vcpkg:          vcpkg install ${arg_VCPKG}\n"
      "  Conan:          ${arg_CONAN}${without}")
endfunction()
