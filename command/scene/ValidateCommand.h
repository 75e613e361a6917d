// SPDX-License-Identifier: Zlib
#pragma once

#include <string>
#include <vector>

namespace command {

/// `wetcloth validate`: loads and builds each scene without running it, and prints "FILE: ok". Throws InputError for
/// the first one that is wrong.
void validateScenes(const std::vector<std::string>& files);

}  // namespace command
