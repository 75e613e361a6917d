// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// What changes with wetness and may change back when a cloth is flooded, linear in between: friction, adhesion.
struct WetnessCurve {
  double dry = 1;             ///< at saturation 0
  double peak = 1;            ///< at saturation peakSaturation
  double flooded = 1;         ///< at saturation 1 and above; unused when peakSaturation is 1
  double peakSaturation = 1;  ///< (0, 1]

  /// The value at a saturation; outside [0, 1] as at its ends.
  double at(double saturation) const {
    if (!(saturation > 0)) return dry;
    if (saturation <= peakSaturation) return dry + (peak - dry) * (saturation / peakSaturation);
    if (peakSaturation >= 1) return peak;
    if (saturation >= 1) return flooded;
    return peak + (flooded - peak) * ((saturation - peakSaturation) / (1 - peakSaturation));
  }
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
