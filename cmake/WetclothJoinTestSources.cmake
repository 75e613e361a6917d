# SPDX-License-Identifier: Zlib
# wetcloth_join_test_sources(<result> <directory> <per_file> <source>...)
#
# Sources in <directory> that include up to <per_file> of the given test files each, in their order and of one folder,
# so that a new file moves few others: a test file costs far more for its headers than for itself. Each keeps names of
# its own in `wetcloth_test`, because that word becomes `wetcloth_test::folderN`; so what the files share there must be
# in the precompiled header, which is read before.
# With <per_file> 1 the sources themselves.
function(wetcloth_join_test_sources result directory per_file)
  if(per_file LESS 2)
    set(${result} ${ARGN} PARENT_SCOPE)
    return()
  endif()
  set(joined "")
  set(folders "")
  foreach(source IN LISTS ARGN)
    cmake_path(GET source PARENT_PATH folder)
    cmake_path(GET folder FILENAME name)
    list(APPEND folders "${name}")
    list(APPEND files_${name} "${source}")
  endforeach()
  list(REMOVE_DUPLICATES folders)
  foreach(name IN LISTS folders)
    list(LENGTH files_${name} count)
    set(content "")
    set(number 0)
    foreach(source IN LISTS files_${name})
      math(EXPR number "${number} + 1")
      # A name that no other file has: all are linked together.
      string(APPEND content "#define wetcloth_test wetcloth_test::${name}${number}\n" #
             "#include \"${source}\"\n" "#undef wetcloth_test\n")
      math(EXPR place "${number} % ${per_file}")
      if(place EQUAL 0 OR number EQUAL count)
        set(file "${directory}/${name}_to_${number}_test.cpp")
        file(CONFIGURE OUTPUT "${file}" CONTENT "${content}" @ONLY)
        list(APPEND joined "${file}")
        set(content "")
      endif()
    endforeach()
  endforeach()
  set(${result} ${joined} PARENT_SCOPE)
endfunction()
