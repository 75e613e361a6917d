# SPDX-License-Identifier: Zlib
message(FATAL_ERROR "The parent's CompileOptions.cmake was included in place of another")
