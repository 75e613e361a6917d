// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/FrameSequence.h"

#include <vector>

namespace pictures {

/// One direction of length 1 per vertex: the sum of its triangles' normals, larger ones counting more; zero where
/// there is no area.
std::vector<Vector3> vertexNormals(const std::vector<Vector3>& vertices, const std::vector<Triangle>& triangles);

}  // namespace pictures
