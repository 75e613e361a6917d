// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Linear RGB, each in [0, 1].
struct Colour {
  double r = 0;  ///< red
  double g = 0;  ///< green
  double b = 0;  ///< blue
};

/// Albedo of a saturated surface whose dry albedo is given (Lekner & Dorf 1988, "Why some things are darker when
/// wet", Applied Optics 27, 1278). With a = 1 - dryAlbedo the wet absorbed fraction is
/// A = (1 - R) a / (1 - p (1 - a)), where R = 0.02 is the reflectance of water at normal incidence and p the share
/// of diffuse light that the water film reflects back inside: 0.435 in Angstrom's form, 0.472 improved.
/// Throws std::invalid_argument when dryAlbedo or p is not in [0, 1].
WETCLOTH_EXPORT double wetAlbedo(double dryAlbedo, double p = 0.472);

/// Colour at a saturation: each channel between its dry and its wet albedo, linear in the saturation, which is
/// clamped to [0, 1]. Throws std::invalid_argument when a channel is not in [0, 1].
WETCLOTH_EXPORT Colour wetColour(const Colour& dry, double saturation);

/// The paper's shown stage (its Fig. 16): 0 dry, then 1 to 4 as the saturation passes 0.1, 0.4, 0.7 and 1, which
/// are 0.093 g, 0.342 g, 0.591 g and 0.84 g of its Table II. Constant from saturation on.
WETCLOTH_EXPORT int paperStage(double saturation);
/// The paper's colour: four equal steps from dry to the darkest colour, wetColour(dry, 1).
/// Throws std::invalid_argument when a channel is not in [0, 1].
WETCLOTH_EXPORT Colour paperColour(const Colour& dry, double saturation);

/// Roughness for a renderer: linear from dry to 0.35 of it at saturation (a wet fabric's film is smoother).
/// The saturation is clamped to [0, 1]. Throws std::invalid_argument when dryRoughness is not in [0, 1].
WETCLOTH_EXPORT double wetRoughness(double dryRoughness, double saturation);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
