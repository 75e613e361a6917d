// SPDX-License-Identifier: Zlib
#include "command/pictures/gl/ColourBar.h"

#include "command/pictures/ColourMap.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace pictures {

float textSizeFor(float areaWidth, float areaHeight) {
  return std::max(10.0F, std::round(std::min(areaHeight / 36, areaWidth / 30)));
}

void drawColourBar(Overlay& overlay, const ColourScale& scale, float areaWidth, float areaHeight) {
  overlay.setTextSize(textSizeFor(areaWidth, areaHeight));
  const float em = overlay.textSize();
  const std::vector<std::string> labels = scale.labels();
  float labelWidth = 0;
  for (const std::string& label : labels) labelWidth = std::max(labelWidth, overlay.widthOf(label));
  const float height = 0.42F * areaHeight;
  const float width = 0.9F * em;
  const float top = 3.2F * em;
  const float left = areaWidth - 1.8F * em - labelWidth - width;
  constexpr int steps = 128;
  for (int i = 0; i < steps; ++i) {
    const Rgb colour = mappedColour((static_cast<float>(i) + 0.5F) / steps);
    const float upper = std::round(top + height * (1 - static_cast<float>(i + 1) / steps));
    const float lower = std::round(top + height * (1 - static_cast<float>(i) / steps));
    overlay.addRectangle(left, upper, width, lower - upper, {colour[0], colour[1], colour[2], 1});
  }
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const float y = top + height * (1 - static_cast<float>(i) / static_cast<float>(labels.size() - 1));
    overlay.addRectangle(left + width, std::round(y) - 1, 0.3F * em, 1, ink);
    overlay.addText(left + width + 0.5F * em, y + 0.33F * em, labels[i], ink);
  }
  const std::string title = scale.title();
  overlay.addText(areaWidth - 1.2F * em - overlay.widthOf(title), 1.9F * em, title, ink);
  overlay.draw(areaWidth, areaHeight);
}

}  // namespace pictures
