// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <cstddef>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class RestMesh;
class Water;

/// The area by which a node touches [m^2], > 0: a third of its triangles at rest; for a node of no triangle its dry
/// mass over its fabric's areal density [kg/m^2], > 0.
double contactArea(const RestMesh& mesh, const Water& water, double arealDensity, std::size_t node);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
