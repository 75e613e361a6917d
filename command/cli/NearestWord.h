// SPDX-License-Identifier: Zlib
#pragma once

#include <string>
#include <vector>

namespace command {

/// Number of insertions, deletions, replacements and swaps of neighbours that turn `a` into `b`.
int editDistance(const std::string& a, const std::string& b);

/// `did you mean "gravity_m_s2"? ` when one of the known words is near, else nothing.
std::string didYouMean(const std::string& word, const std::vector<std::string>& known);

/// The words with commas between them.
std::string joined(const std::vector<std::string>& words);

}  // namespace command
