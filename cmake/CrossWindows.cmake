# SPDX-License-Identifier: Zlib
# A toolchain: Windows, by mingw-w64, run by Wine.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
set(CMAKE_CROSSCOMPILING_EMULATOR /usr/bin/wine)
# Files compiled together have more sections than the older format counts.
set(CMAKE_CXX_FLAGS_INIT -Wa,-mbig-obj)
# Wine knows of no folders of this compiler's libraries. GNU's linker takes minutes for so many sections, LLVM's a moment;
# this GCC asks for no other than GNU's, so that the call is exchanged.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static -fno-use-linker-plugin -wrapper 'sh,-c,exec ld.lld \"$@\"'")
include("${CMAKE_CURRENT_LIST_DIR}/CrossPrefix.cmake")
