// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/Scene.h"

#include <memory>

namespace command {

/// A soft body from a mesh of triangles: a link along each edge, a bending link across each inner edge, and as mass
/// of a node a third of its triangles'. Bullet's own CreateFromTriMesh needs memory that grows as the square of the
/// number of nodes, and makes every node equally heavy.
std::unique_ptr<btSoftBody> makeMeshBody(const TriangleMesh& mesh, double arealDensity, btSoftBodyWorldInfo& worldInfo);

}  // namespace command
