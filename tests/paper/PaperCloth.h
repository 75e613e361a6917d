// SPDX-License-Identifier: Zlib
#pragma once

#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/Patches.h"

#include <cmath>

namespace wetcloth_test {

/// A patch whose inner nodes weigh the 0.01 g of Table II when dry: each has a cell of 1/1000 m^2 of 10 g/m^2.
inline wetcloth::ClothPatch paperPatch(int n = 32) {
  return levelPatch(n, (n - 1) / std::sqrt(1000.0), wetcloth::Fabric::tableII().arealDensity);
}

/// The same, hanging in the plane z = 0 from its upper edge, j = 0.
inline wetcloth::ClothPatch hangingPaperPatch(int n = 32) {
  wetcloth::ClothPatch patch = paperPatch(n);
  const btScalar side = patch.edgeU.x();
  patch.origin = btVector3(0, 0, 0);
  patch.edgeV = btVector3(0, -side, 0);
  patch.pinnedEdges = {wetcloth::ClothPatch::Edge::bottom};
  return patch;
}

/// A dry inner node of paperPatch(n).
inline int innerNode(const wetcloth::ClothPatch& patch) { return patch.node(patch.columns / 2, patch.rows / 2); }

constexpr double kGram = 1e-3;  // [kg]
constexpr WorldKind kAllWorlds[] = {WorldKind::softRigid, WorldKind::softMultiBody, WorldKind::deformable,
                                    WorldKind::deformableImplicit};

}  // namespace wetcloth_test
