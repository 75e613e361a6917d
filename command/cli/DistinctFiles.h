// SPDX-License-Identifier: Zlib
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace command {

/// Throws InputError when two of these name the same file, so that none is written over another or over the input.
/// @param files  what each is, such as "--json", and its path; "" and "-" are none
void requireDistinctFiles(const std::vector<std::pair<std::string, std::string>>& files);

}  // namespace command
