# SPDX-License-Identifier: Zlib
# wetcloth_require(<package> FOR <part> [OPTION <option>])
#
# find_package(<package>) whose error says what to install, or which option does without.
function(wetcloth_require package)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "FOR;OPTION" "")
  find_package(${package} QUIET)
  if(${package}_FOUND)
    return()
  endif()

  wetcloth_package_names(${package} debian homebrew vcpkg conan)
  set(without "")
  if(arg_OPTION)
    set(without "\n  or do without: cmake -D${arg_OPTION}=OFF")
  endif()
  message(
    FATAL_ERROR
      "${package} was not found; ${arg_FOR} needs it. Install it:\n"
      "  Debian, Ubuntu: apt install ${debian}\n"
      "  Homebrew:       brew install ${homebrew}\n"
      "  vcpkg:          vcpkg install ${vcpkg}\n"
      "  Conan:          ${conan}${without}")
endfunction()

# wetcloth_package_names(<package> <debian> <homebrew> <vcpkg> <conan>): sets these to its row of packages.txt.
function(wetcloth_package_names package debian homebrew vcpkg conan)
  file(STRINGS "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/packages.txt" row REGEX "^${package} ")
  string(REGEX REPLACE " +" ";" row "${row}")
  list(LENGTH row columns)
  if(NOT columns EQUAL 6)
    message(FATAL_ERROR "cmake/packages.txt has no complete row \"${package}\"")
  endif()
  list(GET row 2 names)
  set(${debian} ${names} PARENT_SCOPE)
  list(GET row 3 names)
  set(${homebrew} ${names} PARENT_SCOPE)
  list(GET row 4 names)
  set(${vcpkg} ${names} PARENT_SCOPE)
  list(GET row 5 names)
  set(${conan} ${names} PARENT_SCOPE)
endfunction()
