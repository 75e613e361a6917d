// SPDX-License-Identifier: Zlib
#pragma once

#include "tests/support/BulletWorld.h"
#include "tests/support/Patches.h"
#include "tests/support/RigidBody.h"
#include "tests/support/SoftBodies.h"

namespace wetcloth_test {

/// Collision flags with which each world lists contacts of nodes with rigid bodies and with other soft bodies.
inline int contactFlags(WorldKind kind) {
  using Flags = btSoftBody::fCollision;
  const bool isDeformable = kind == WorldKind::deformable || kind == WorldKind::deformableImplicit;
  return isDeformable ? Flags::SDF_RD | Flags::SDF_RDN | Flags::VF_DD : Flags::SDF_RS | Flags::VF_SS;
}

/// Collision margin of the cloths [m].
inline constexpr double kMargin = 0.02;

/// A cloth of n x n nodes at height y, by default lying on a box whose top is at 0.
struct Lying {
  int n = 4;
  double side = 0.3;
  double height = kMargin * 0.9;
  double arealDensity = 0.150;

  BodyBuilder builder(WorldKind kind) const {
    return [*this, kind](btSoftBodyWorldInfo& info) {
      wetcloth::ClothPatch patch = levelPatch(n, side, arealDensity);
      patch.origin.setY(btScalar(height));
      auto body = patch.build(info);
      body->m_cfg.collisions = contactFlags(kind);
      body->getCollisionShape()->setMargin(btScalar(kMargin));
      return body;
    };
  }
};

}  // namespace wetcloth_test
