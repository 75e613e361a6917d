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
/// get their area times the mean areal density of the free nodes of their fabric, or that fabric's own when none of its
/// nodes is free, or the mean free mass of it when there are no faces.
/// Throws std::invalid_argument when there is no node, a mass is not finite, or nothing tells a pinned node's mass.
/// @param arealDensities  of each fabric [kg/m^2]
/// @param fabricOfNode    of each node, a place in `arealDensities`
WETCLOTH_EXPORT std::vector<double> dryMasses(const btSoftBody& body, const std::vector<double>& arealDensities,
                                              const std::vector<int>& fabricOfNode);

/// After the body was cut or refined: gives the new nodes (at the end of m_nodes) the water that Bullet's sharing of
/// masses took from the old ones. The total is kept, and no node is over-full that was not so before, but one of a
/// fabric that holds less than the one that its water came from. An old node whose mass Bullet left alone keeps its
/// water; one whose mass Bullet reduced keeps its saturation. A new node is of the fabric of the nearest old node that
/// it is linked to, and so each side of a cut along a seam stays what it was; without such a link, of the nearest of
/// all.
/// @param arealDensities  of each fabric of the water [kg/m^2]
WETCLOTH_EXPORT void redistributeWater(const btSoftBody& body, const std::vector<double>& arealDensities, Water& water);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
