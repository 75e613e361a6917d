# SPDX-License-Identifier: Zlib
# A toolchain: WebAssembly, by Emscripten, run by Node or a browser. WETCLOTH_CROSS_PREFIX has Bullet and what else is
# needed (cross.sh).
execute_process(
  COMMAND em-config EMSCRIPTEN_ROOT
  OUTPUT_VARIABLE emscripten
  OUTPUT_STRIP_TRAILING_WHITESPACE)
include("${emscripten}/cmake/Modules/Platform/Emscripten.cmake")
# Exceptions of WebAssembly's own and vectors of 128 bits, which every browser has had since 2021 (Safari: 16.4).
set(CMAKE_C_FLAGS_INIT "-msimd128")
set(CMAKE_CXX_FLAGS_INIT "-msimd128 -fwasm-exceptions")
set(CMAKE_EXE_LINKER_FLAGS_INIT "-fwasm-exceptions")
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES WETCLOTH_CROSS_PREFIX)
set(CMAKE_FIND_ROOT_PATH "${WETCLOTH_CROSS_PREFIX}")
foreach(kind IN ITEMS LIBRARY INCLUDE PACKAGE)
  set(CMAKE_FIND_ROOT_PATH_MODE_${kind} ONLY)
endforeach()
