// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/Collider.h"

#include <BulletCollision/CollisionShapes/btCollisionShape.h>

#include <memory>

namespace command {

/// What Bullet knows a collider by.
struct ColliderShape {
  std::unique_ptr<btCollisionShape> shape;
  btTransform rest;  ///< of its own frame, when the collider is at rest
};

/// Soft bodies collide with no planes: one becomes the top of a large, thick box.
ColliderShape shapeOf(const Collider& collider);

}  // namespace command
