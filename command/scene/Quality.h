// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/Scene.h"

#include <string>

namespace command {

/// How a scene's stepping was chosen, for people: the name of a quality, or "scene" where it decides by itself.
std::string qualityOf(const Scene& scene);

/// How far a scene may be off: the largest of the measured errors that bear on it.
enum class Quality { draft, realtime, accurate, reference };

/// "draft" and so on, from the coarsest.
const NamedValues<Quality>& qualityNames();

/// The error that a quality allows [-]: 10 %, 3 %, 1 %; of `reference` 0, which nothing reaches: the most accurate
/// stepping that was measured.
double allowedError(Quality quality);

}  // namespace command
