# wetcloth_join_test_sources(<result> <directory> <per_file> <source>...)
#
# Sources in <directory> that include up to <per_file> of the given test files each, in their order: a test file costs
# far more for its headers than for itself. Each keeps names of its own in `wetcloth_test`, because that word becomes
# `wetcloth_test::fileN`; so what the files share there must be in the precompiled header, which is read before.
# With <per_file> 1 the sources themselves.
function(wetcloth_join_test_sources result directory per_file)
  if(per_file LESS 2)
    set(${result} ${ARGN} PARENT_SCOPE)
    return()
  endif()
  set(joined "")
  set(content "")
  set(number 0)
  foreach(source IN LISTS ARGN)
    math(EXPR number "${number} + 1")
    string(APPEND content "#define wetcloth_test wetcloth_test::file${number}\n" #
           "#include \"${source}\"\n" "#undef wetcloth_test\n")
    math(EXPR place "${number} % ${per_file}")
    list(LENGTH ARGN count)
    if(place EQUAL 0 OR number EQUAL count)
      set(file "${directory}/to_${number}_test.cpp")
      file(CONFIGURE OUTPUT "${file}" CONTENT "${content}" @ONLY)
      list(APPEND joined "${file}")
      set(content "")
    endif()
  endforeach()
  set(${result} ${joined} PARENT_SCOPE)
endfunction()
