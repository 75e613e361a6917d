// SPDX-License-Identifier: Zlib
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace command {

/// The cells of one line of a CSV file, without the blanks around them and without the quotes they may stand in.
/// @param place  of the line, for complaints: "data.csv: line 3"
/// Throws InputError when a quote is not closed, or no comma follows on one that is.
std::vector<std::string> cellsOf(std::string_view line, const std::string& place);

}  // namespace command
