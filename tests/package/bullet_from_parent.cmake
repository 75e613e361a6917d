# SPDX-License-Identifier: Zlib
# Targets of a parent build come before everything else: targets that the parent found, targets that it wraps, and
# Bullet's own source tree as a subdirectory, whose targets say nothing about their headers or their precision.
include("${CMAKE_CURRENT_LIST_DIR}/package_test.cmake")

# Headers as in Bullet's source tree, beside the libraries' directories
set(source_tree "${WORK_DIR}/source_tree")
file(REMOVE_RECURSE "${source_tree}")
file(COPY "${CMAKE_CURRENT_LIST_DIR}/bullet_parent/source_tree" DESTINATION "${WORK_DIR}")
file(GLOB headers RELATIVE "${BULLET_INCLUDE}" "${BULLET_INCLUDE}/*")
foreach(name IN LISTS headers)
  if(IS_DIRECTORY "${source_tree}/src/${name}")
    file(GLOB parts RELATIVE "${BULLET_INCLUDE}" "${BULLET_INCLUDE}/${name}/*")
  else()
    set(parts "${name}")
  endif()
  foreach(part IN LISTS parts)
    file(CREATE_LINK "${BULLET_INCLUDE}/${part}" "${source_tree}/src/${part}" SYMBOLIC)
  endforeach()
endforeach()

foreach(precision IN LISTS PRECISIONS)
  foreach(style IN ITEMS imported interface subdirectory)
    set(build "${WORK_DIR}/${style}-${precision}")
    string(REPLACE ";" "," libraries "${BULLET_LIBRARIES_${precision}}")
    configure("${CMAKE_CURRENT_LIST_DIR}/bullet_parent" "${build}" -DSTYLE=${style} -DPRECISION=${precision}
              "-DSOURCE_TREE=${source_tree}" "-DPARENTS_INCLUDE=${BULLET_INCLUDE}" "-DPARENTS_LIBRARIES=${libraries}")
    run("${CMAKE_COMMAND}" --build "${build}" --target user)
    run("${build}/user")
  endforeach()
endforeach()
