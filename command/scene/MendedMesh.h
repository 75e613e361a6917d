// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/TriangleMesh.h"

namespace command {

/// The mesh as a cloth wants it: vertices in one place joined into one node, faces without area and those that are
/// there twice left out; nodeOfVertex and remarks tell which (wetcloth::checkMesh()). What cannot be mended, a vertex
/// without any area around it, throws std::invalid_argument that names all of them, numbered from 1.
TriangleMesh mended(TriangleMesh mesh);

}  // namespace command
