// SPDX-License-Identifier: Zlib
#pragma once

#include <functional>

namespace command {

/// Whether a function comes to its end, thrown out of or not, in a copy of this process: that copy is all that it can
/// crash or hold up. For other people's readers, which trust what is in a file. True without a trial where the system
/// does not copy processes (Windows).
bool survivesTrial(const std::function<void()>& trial);

}  // namespace command
