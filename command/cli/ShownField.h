// SPDX-License-Identifier: Zlib
#pragma once

#include <string>
#include <string_view>

namespace command {

/// A field of a file in quotes, for an error message, whatever it has in it: its first 40 bytes, those that are not
/// printable ASCII as \xNN.
std::string shownField(std::string_view field);

}  // namespace command
