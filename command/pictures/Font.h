// SPDX-License-Identifier: Zlib
#pragma once

#include <string_view>

namespace pictures {

/// The bytes of a TrueType font with ASCII and little else, which is part of the program.
std::string_view fontFile();

}  // namespace pictures
