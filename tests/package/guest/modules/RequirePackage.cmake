# SPDX-License-Identifier: Zlib
message(FATAL_ERROR "The parent's RequirePackage.cmake was included in place of another")
