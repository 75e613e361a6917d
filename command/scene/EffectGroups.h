// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/EffectCatalogue.h"

namespace command {

// The catalogue in parts, each beside the readers of its effects.
EffectCatalogue springEffects();
EffectCatalogue sourceEffects();
EffectCatalogue transportEffects();
EffectCatalogue lossEffects();
EffectCatalogue materialEffects();
EffectCatalogue forceEffects();
EffectCatalogue contactEffects();
EffectCatalogue auditEffects();

}  // namespace command
