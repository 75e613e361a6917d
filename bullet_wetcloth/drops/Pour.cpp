// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/drops/Pour.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/numerics/DropFlight.h"
#include "bullet_wetcloth/numerics/TiltedGlass.h"

#include <cmath>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr double kRightAngle = 1.5707963267948966;

void requireDiameter(const std::string& field, double diameter) {
  if (!(diameter > 0 && diameter <= 0.1)) rejectValue(field, diameter, "in (0, 0.1]");
}

}  // namespace

void requireValid(const std::string& prefix, const Pour& pour) {
  requireFinite(prefix + ".position", pour.position);
  requireFinite(prefix + ".velocity", pour.velocity);
  requireNotNegative(prefix + ".flow", pour.flow);
  requireDiameter(prefix + ".dropDiameter", pour.dropDiameter);
  requireNotNegative(prefix + ".mouthRadius", pour.mouthRadius);
  if (!(pour.halfAngle >= 0 && pour.halfAngle < kRightAngle)) {
    rejectValue(prefix + ".halfAngle", pour.halfAngle, "in [0, pi/2)");
  }
  requireFinite(prefix + ".start", pour.start);
  if (!(pour.stop >= pour.start)) rejectValue(prefix + ".stop", pour.stop, "no earlier than start");
}

void requireValid(const std::string& prefix, const Glass& glass) {
  requirePositive(prefix + ".radius", glass.radius);
  requirePositive(prefix + ".height", glass.height);
  requireNotNegative(prefix + ".water", glass.water);
  const double most = DropAir().waterDensity * heldInTiltedGlass(glass.radius, glass.height, 1);
  if (glass.water > most) rejectValue(prefix + ".water", glass.water, "no more than it holds, " + std::to_string(most));
  requireDiameter(prefix + ".dropDiameter", glass.dropDiameter);
  requirePositive(prefix + ".timeConstant", glass.timeConstant);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
