# SPDX-License-Identifier: Zlib
message(FATAL_ERROR "The parent's Precision.cmake was included in place of another")
