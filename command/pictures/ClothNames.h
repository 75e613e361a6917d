// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/FrameSequence.h"

#include <string>
#include <vector>

namespace pictures {

/// Names for files and for things in files: ASCII letters, digits and _, not first a digit, and no two the same, not
/// even where case is ignored. What is allowed already stays as it is when nothing before it has that name.
std::vector<std::string> uniqueNames(const std::vector<std::string>& names);

/// The cloths' names, made unique.
std::vector<std::string> clothNames(const FrameSequence& sequence);

/// The text as a comment may have it in any format: what is no printable ASCII becomes a space.
std::string onOneLine(std::string text);

}  // namespace pictures
