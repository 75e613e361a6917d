// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/shading/Colour.h"

class btIDebugDraw;

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class WetCloth;
class WetClothWorld;

/// Draws the wet cloths with the application's own drawer: triangles coloured by saturation (saturationColour()), and
/// as red lines the force of the air per area on each (Wind::traction()), `metresPerPascal` long for each pascal
/// [m/Pa], finite; 0 draws none. Cloths whose bodies left the world are left out. Call it where the application calls
/// btDynamicsWorld::debugDrawWorld(); the drawer's debug mode is not asked.
/// Throws std::invalid_argument when metresPerPascal is not finite.
WETCLOTH_EXPORT void debugDraw(const WetClothWorld& world, btIDebugDraw& drawer, double metresPerPascal = 0.01);

/// Colour by which a saturation is told apart on a screen (sRGB, no fabric's own): sand when dry, through green, to a
/// dark blue from saturation 1 on. Brightness falls all the way. The saturation is clamped to [0, 1].
WETCLOTH_EXPORT Colour saturationColour(double saturation);

/// Draws a cloth's triangles, each in the saturationColour() of its corners' mean saturation.
WETCLOTH_EXPORT void drawSaturation(const WetCloth& cloth, btIDebugDraw& drawer);

/// Draws the traction of each Wind of a cloth, Wind::traction(), as a line from the centre of each triangle, in red;
/// nothing where there is none.
/// @param time  at which to ask the wind [s]; @param metresPerPascal  length of a line over the traction [m/Pa]; throws
/// std::invalid_argument unless it is finite
WETCLOTH_EXPORT void drawWind(const WetCloth& cloth, btIDebugDraw& drawer, double time, double metresPerPascal);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
