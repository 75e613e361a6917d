# SPDX-License-Identifier: Zlib
# A parent build, the command line and the environment choose their own launcher: ours is only a default.
if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  find_program(WETCLOTH_CCACHE ccache)
  mark_as_advanced(WETCLOTH_CCACHE)
  if(WETCLOTH_CCACHE)
    # It takes the files that the compiler names for those that count, and need not preprocess them itself.
    set(CMAKE_CXX_COMPILER_LAUNCHER "${CMAKE_COMMAND};-E;env;CCACHE_DEPEND=1;${WETCLOTH_CCACHE}")
  endif()
endif()
