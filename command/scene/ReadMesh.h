// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/JsonCursor.h"
#include "command/scene/ObjReader.h"
#include "command/scene/TriangleMesh.h"

#include <string>

namespace command {

/// "scale", "rotation_deg" and "translation_m" of an object that may have them.
Placement readPlacement(const JsonCursor& cursor);
/// The name of an OBJ file, or an object with the name and where its mesh is put.
TriangleMesh readMesh(JsonCursor cursor);
/// A file that a scene names: beside the scene, unless the name begins at the root.
std::string fileBeside(const JsonCursor& name);

}  // namespace command
