# SPDX-License-Identifier: Zlib
# The installed command, moved, brings its scenes, their schema, its queries and its measurements, and finds them from any folder.
include("${CMAKE_CURRENT_LIST_DIR}/package_test.cmake")

set(prefix "${WORK_DIR}/prefix")
file(REMOVE_RECURSE "${prefix}" "${prefix}-moved")
run("${CMAKE_COMMAND}" --install "${BUILD_DIR}" --config "${CONFIG}" --prefix "${prefix}" --component command)
file(RENAME "${prefix}" "${prefix}-moved")
file(GLOB_RECURSE installed RELATIVE "${prefix}-moved" "${prefix}-moved/*")
must_match("${installed}" "bin/wetcloth" "share/bullet_wetcloth/scenes/scene.schema.json")

set(command "${CMAKE_COMMAND}" -E chdir "${WORK_DIR}" "${prefix}-moved/bin/wetcloth")
run(${command} validate hanging_towel.json)
run(${command} accuracy --study collision --quick --json -)
must_match("${output}" "\"collision")
run(${command} reality --study sheet --json -)
must_match("${output}" "fall_a4_sheet_2013")

# Nothing in the programs says where they were built from.
file(GLOB programs "${prefix}-moved/bin/*")
foreach(program IN LISTS programs)
  file(STRINGS "${program}" places REGEX "${SOURCE_DIR}/(tests|examples|command/scene)/.*(json|gz)")
  if(places)
    message(FATAL_ERROR "${program} mentions ${places}")
  endif()
endforeach()
