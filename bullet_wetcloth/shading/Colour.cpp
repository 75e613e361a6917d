// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/shading/Colour.h"

#include "bullet_wetcloth/Require.h"

#include <algorithm>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr double kWaterReflectance = 0.02;  // normal incidence, n = 1.33
constexpr double kSaturatedRoughnessShare = 0.35;

double clampedFraction(double value) { return value > 0 ? std::min(value, 1.0) : 0.0; }

Colour mix(const Colour& a, const Colour& b, double share) {
  return {a.r + (b.r - a.r) * share, a.g + (b.g - a.g) * share, a.b + (b.b - a.b) * share};
}

Colour saturatedColour(const Colour& dry) { return {wetAlbedo(dry.r), wetAlbedo(dry.g), wetAlbedo(dry.b)}; }

}  // namespace

double wetAlbedo(double dryAlbedo, double p) {
  requireFraction("dryAlbedo", dryAlbedo);
  requireFraction("p", p);
  const double dryAbsorbed = 1 - dryAlbedo;
  if (dryAbsorbed == 0)
    return 1;  // nothing is absorbed, however often the light comes back; the formula is 0/0 at p = 1
  const double wetAbsorbed = (1 - kWaterReflectance) * dryAbsorbed / (1 - p * (1 - dryAbsorbed));
  return 1 - wetAbsorbed;
}

Colour wetColour(const Colour& dry, double saturation) {
  return mix(dry, saturatedColour(dry), clampedFraction(saturation));
}

int paperStage(double saturation) {
  int stage = 0;
  for (const double threshold : {0.1, 0.4, 0.7, 1.0}) {
    // The thresholds are masses of Table II divided by each other: a saturation that should equal one is a rounding
    // error away from it.
    if (saturation >= threshold - 1e-9) ++stage;
  }
  return stage;
}

Colour paperColour(const Colour& dry, double saturation) {
  return mix(dry, saturatedColour(dry), paperStage(saturation) / 4.0);
}

double wetRoughness(double dryRoughness, double saturation) {
  requireFraction("dryRoughness", dryRoughness);
  return dryRoughness * (1 - (1 - kSaturatedRoughnessShare) * clampedFraction(saturation));
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
