// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/Scene.h"

#include <string>

namespace command {

/// Bullet's precision is chosen when a program is compiled, so there are two programs: `wetcloth` and, in the same
/// directory, `wetcloth-float64`. When this one has another precision than is wanted, goes on as the other one with
/// the same arguments and does not return. Throws InputError when the other one is not there.
/// @param wantedBy the file and JSON pointer, or the option, that wants the precision
void continueInPrecision(Precision wanted, const std::string& wantedBy, char** arguments);

/// Where the program of that precision is; empty when it is not there.
/// @param arguments  of this program
std::string programOf(Precision precision, char** arguments);

}  // namespace command
