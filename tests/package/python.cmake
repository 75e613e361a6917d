# SPDX-License-Identifier: Zlib
# The installed Python package, moved: its own tests and the examples, in each precision. A process has one of them.
include("${CMAKE_CURRENT_LIST_DIR}/package_test.cmake")

set(prefix "${WORK_DIR}/prefix")
file(REMOVE_RECURSE "${prefix}" "${prefix}-moved")
foreach(component IN ITEMS python command)
  run("${CMAKE_COMMAND}" --install "${BUILD_DIR}" --config "${CONFIG}" --prefix "${prefix}" --component ${component})
endforeach()
file(RENAME "${prefix}" "${prefix}-moved")

set(ENV{PYTHONPATH} "${prefix}-moved/${PYTHON_DIR}")
set(ENV{PYTHONDONTWRITEBYTECODE} 1)
set(python "${CMAKE_COMMAND}" -E chdir "${WORK_DIR}" "${PYTHON}")
foreach(precision IN LISTS PRECISIONS)
  set(ENV{WETCLOTH_PRECISION} ${precision})
  run(${python} "${SOURCE_DIR}/tests/python/wetcloth_test.py")
  must_match("${output}" "OK")
endforeach()

# The paper's numbers to a substep of 1/240 s, and a wind that is found to half of the last digit that is told.
run(${python} "${SOURCE_DIR}/examples/python/two_falls.py")
must_match("${output}" "0.010 0.093 0.176 0.259 0.342 0.425 0.508 0.591 0.674 0.757 0.840" "dry +fall: 4.00[0-9] s"
           "saturated +fall: 2.01[0-9] s")
run(${python} "${SOURCE_DIR}/examples/python/learn_the_wind.py")
must_match("${output}" "learned \\[3. +0.3 +1.2 *\\]")
