# SPDX-License-Identifier: Zlib
# Libraries are found under the names that Bullet's own build and the distributions give them, and their precision is
# what they are, not what they are called.
include("${CMAKE_CURRENT_LIST_DIR}/fake_prefix.cmake")

set(prefix "${WORK_DIR}/prefix")
search_in("${prefix}")
set(suffixes "" _RelWithDebugInfo _MinsizeRel _Debug)
set(precisions float32 float64 float32 float64)
foreach(suffix precision IN ZIP_LISTS suffixes precisions)
  fake_prefix("${prefix}" ${precision} "${suffix}")
  found("${prefix}")
  must_match("${output}" "the system, ${prefix}, ${precision} ")
endforeach()

# Debian: both, by suffix. Homebrew: both, by folder. vcpkg: debug libraries in a folder of their own.
fake_prefix("${prefix}" float32)
fake_libraries("${prefix}/lib" float64 "-float64")
found("${prefix}")
must_match("${output}" "float32, float64 " "SoftBody: [^ ]* and [^ ]*BulletSoftBody[.]"
           "SoftBody-float64: [^ ]* and [^ ]*BulletSoftBody-float64[.]")

fake_prefix("${prefix}")
file(REMOVE_RECURSE "${prefix}/lib")
fake_libraries("${prefix}/lib/bullet/single" float32 "")
fake_libraries("${prefix}/lib/bullet/double" float64 "")
found("${prefix}")
must_match("${output}" "float32, float64 ")

fake_prefix("${prefix}")
fake_libraries("${prefix}/debug/lib" float32 _Debug)
search_in("${prefix}/debug" "${prefix}")
found("${prefix}")
