// SPDX-License-Identifier: Zlib
#pragma once

#include "tests/consumer/ForwardOnly.h"

namespace consumer {

/// Adds an effect of the application's own.
void addSponge(wetcloth::WetCloth& cloth);
/// How often that effect has been applied; -1 when it is not found.
int stepsOfSponge(const wetcloth::WetCloth& cloth);

void addRain(wetcloth::WetCloth& cloth);

}  // namespace consumer
