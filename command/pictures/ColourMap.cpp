// SPDX-License-Identifier: Zlib
#include "command/pictures/ColourMap.h"

#include <algorithm>
#include <cstddef>

namespace pictures {

/// M. Zucker's polynomial.
Rgb mappedColour(float value) {
  constexpr float factors[7][3] = {{0.27773F, 0.00541F, 0.33410F},   {0.10509F, 1.40461F, 1.38459F},
                                   {-0.33086F, 0.21485F, 0.09510F},  {-4.63423F, -5.79910F, -19.33244F},
                                   {6.22827F, 14.17993F, 56.69055F}, {4.77638F, -13.74515F, -65.35303F},
                                   {-5.43546F, 4.64585F, 26.31244F}};
  const float t = std::min(1.0F, std::max(0.0F, value));
  Rgb colour{};
  for (std::size_t channel = 0; channel < 3; ++channel) {
    for (int power = 6; power >= 0; --power) colour[channel] = colour[channel] * t + factors[power][channel];
    colour[channel] = std::min(1.0F, std::max(0.0F, colour[channel]));
  }
  return colour;
}

}  // namespace pictures
