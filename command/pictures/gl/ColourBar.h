// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/gl/Overlay.h"

#include "command/pictures/ColourScale.h"

namespace pictures {

/// Colour of text.
constexpr Overlay::Tint ink{0.16F, 0.20F, 0.25F, 1};

/// Size of the text in a picture [pixels].
float textSizeFor(float areaWidth, float areaHeight);

/// An upright bar of a scale's colours at the right of a picture, with numbers.
void drawColourBar(Overlay& overlay, const ColourScale& scale, float areaWidth, float areaHeight);

}  // namespace pictures
