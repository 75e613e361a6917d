// SPDX-License-Identifier: Zlib
#include "command/pictures/ClothColour.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pictures {
namespace {

float clamped(float value) { return std::min(1.0F, std::max(0.0F, value)); }

float encoded(float linear) {
  return linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1 / 2.4F) - 0.055F;
}

}  // namespace

Rgb clothColour(const ClothShape& cloth, float saturation) {
  const float wet = clamped(saturation);
  Rgb colour{};
  for (std::size_t i = 0; i < 3; ++i) colour[i] = (1 - wet) * cloth.dryColour[i] + wet * cloth.wetColour[i];
  return colour;
}

std::array<std::uint8_t, 3> encodedColour(const Rgb& linear) {
  std::array<std::uint8_t, 3> colour{};
  for (std::size_t i = 0; i < 3; ++i) {
    colour[i] = static_cast<std::uint8_t>(std::lround(255 * encoded(clamped(linear[i]))));
  }
  return colour;
}

}  // namespace pictures
