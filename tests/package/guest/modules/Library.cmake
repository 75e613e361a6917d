# SPDX-License-Identifier: Zlib
message(FATAL_ERROR "The parent's Library.cmake was included in place of another")
