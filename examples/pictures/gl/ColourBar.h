#pragma once

#include "Overlay.h"

#include "../ColourScale.h"

namespace pictures {

/// Size of the text in a picture [pixels].
float textSizeFor(float areaWidth, float areaHeight);

/// An upright bar of a scale's colours at the right of a picture, with numbers.
void drawColourBar(Overlay& overlay, const ColourScale& scale, float areaWidth, float areaHeight);

}  // namespace pictures
