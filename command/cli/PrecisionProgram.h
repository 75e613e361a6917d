// SPDX-License-Identifier: Zlib
#pragma once

#include "command/cli/Precision.h"

#include <string>

namespace command {

// Bullet's precision is chosen when a program is compiled, so there are two programs: `wetcloth` and, in the same
// directory, `wetcloth-float64`.

/// Where the program of that precision is; empty when it is not there.
std::string programOf(Precision precision);

/// When this program has another precision than is wanted, goes on as the other one with the same arguments and does
/// not return. Throws InputError when the other one is not there.
/// @param arguments  of main(), with the null that ends them
void continueIn(const PrecisionWish& wish, char** arguments);

}  // namespace command
