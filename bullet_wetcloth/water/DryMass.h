// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/water/Water.h"

#include <BulletSoftBody/btSoftBody.h>

#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Area of each node [m^2], a third of its triangles, in the present shape. Zero without faces.
WETCLOTH_EXPORT std::vector<double> nodeAreas(const btSoftBody& body);

/// Dry mass of each node [kg] of a dry body: Bullet's own for free nodes. Bullet keeps no mass for pinned ones: they
/// get their area times the free nodes' mean areal density, or `arealDensity` [kg/m^2] when no node is free, or the
/// mean free mass when there are no faces.
/// Throws std::invalid_argument when there is no node, a mass is not finite, or nothing tells a pinned node's mass.
WETCLOTH_EXPORT std::vector<double> dryMasses(const btSoftBody& body, double arealDensity);

/// After the body was cut or refined: gives the new nodes (at the end of m_nodes) the water that Bullet's sharing of
/// masses took from the old ones. The total is kept, and no node is over-full that was not so before. An old node whose
/// mass Bullet left alone keeps its water; one whose mass Bullet reduced keeps its saturation.
WETCLOTH_EXPORT void redistributeWater(const btSoftBody& body, double arealDensity, Water& water);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
