// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class RestMesh;

/// A sign for each triangle of a mesh, whichever way round it has their corners: of two neighbours, the normals
/// (b - a) x (c - a) times their signs point to the same side of the cloth. +1 for the first triangle of each piece; 0
/// for one without area, and for a doubled one. Triangles are neighbours across an edge that no third one has. A
/// surface with one side only, such as a Moebius strip, has a seam where neighbours differ. O(triangles).
std::vector<int> faceWindings(const RestMesh& mesh);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
