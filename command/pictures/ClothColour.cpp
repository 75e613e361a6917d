// SPDX-License-Identifier: Zlib
#include "command/pictures/ClothColour.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pictures {
namespace {

float clamped(float value) { return std::min(1.0F, std::max(0.0F, value)); }

Rgb colourOf(const FabricLook& look, float saturation) {
  const float wet = clamped(saturation);
  Rgb colour{};
  for (std::size_t i = 0; i < 3; ++i) colour[i] = (1 - wet) * look.dryColour[i] + wet * look.wetColour[i];
  return colour;
}

float encoded(float linear) {
  return linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1 / 2.4F) - 0.055F;
}

}  // namespace

std::vector<Rgb> clothColours(const ClothShape& cloth, const std::vector<float>& saturation) {
  std::vector<Rgb> colours;
  for (const float wet : saturation) colours.push_back(colourOf(cloth.parts.front().look, wet));
  std::size_t triangle = cloth.triangles.size();
  for (auto part = cloth.parts.rbegin(); part != cloth.parts.rend(); ++part) {  // the first has the last word
    for (std::size_t i = 0; i < part->triangles; ++i) {
      for (const int corner : cloth.triangles[--triangle]) {
        const auto node = static_cast<std::size_t>(corner);
        colours[node] = colourOf(part->look, saturation[node]);
      }
    }
  }
  return colours;
}

std::array<std::uint8_t, 3> encodedColour(const Rgb& linear) {
  std::array<std::uint8_t, 3> colour{};
  for (std::size_t i = 0; i < 3; ++i) {
    colour[i] = static_cast<std::uint8_t>(std::lround(255 * encoded(clamped(linear[i]))));
  }
  return colour;
}

}  // namespace pictures
