// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <BulletSoftBody/btSoftBody.h>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Whether the links of a body are to be passed in their order and then back in each small step, not once.
///
/// A pass over links is a product of projections. There and back it is self-adjoint with the masses as metric, and then
/// no step of the linear equations gains energy. One way it is not: a cloth trembles where an eigenvalue 1 - e + i f
/// has f > e^(3/2). Meshes whose links hold each other in many directions stay far from that (measured;
/// docs/solver.md). Two kinds come near it: cloths with no more links than the edges of triangles, and meshes with many
/// triangles that have an angle above 150 degrees, whose links are nearly parallel.
bool needsBothWays(const btSoftBody& body);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
