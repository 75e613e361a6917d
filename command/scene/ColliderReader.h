// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/Collider.h"
#include "command/scene/JsonCursor.h"

namespace command {

/// An element of a scene's "colliders".
Collider readCollider(JsonCursor cursor);
Box readBox(JsonCursor cursor);
Sphere readSphere(JsonCursor cursor);
/// @param middle  about which it turns unless it says otherwise
RigidMotion readRigidMotion(JsonCursor cursor, const btVector3& middle);

}  // namespace command
