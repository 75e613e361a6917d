# SPDX-License-Identifier: Zlib
# A toolchain: Windows, by mingw-w64, run by Wine. WETCLOTH_CROSS_PREFIX has Bullet and what else is needed (cross.sh).
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
set(CMAKE_CROSSCOMPILING_EMULATOR wine)
# Files compiled together have more sections than the older format counts.
set(CMAKE_CXX_FLAGS_INIT -Wa,-mbig-obj)
# Wine knows of no folders of this compiler's libraries.
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES WETCLOTH_CROSS_PREFIX)
set(CMAKE_FIND_ROOT_PATH "${WETCLOTH_CROSS_PREFIX}")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
