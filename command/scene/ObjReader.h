// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/Scene.h"

#include <string>

namespace command {

/// The vertices and faces of a Wavefront OBJ file; faces with more than three corners become fans of triangles, all
/// else (normals, texture coordinates, groups, materials) is passed over. Lengths are metres.
/// Throws std::invalid_argument naming the line, the value and what is allowed.
TriangleMesh readObj(const std::string& file);

}  // namespace command
