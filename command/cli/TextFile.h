// SPDX-License-Identifier: Zlib
#pragma once

#include <string>

namespace command {

/// The file's whole text. Throws std::invalid_argument that says why it cannot be had: "no such file", "is a
/// directory", "cannot be read", "is longer than 256 MB, the most that is read", "is empty".
std::string readTextFile(const std::string& path);

}  // namespace command
