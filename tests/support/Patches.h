// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/mesh/ClothPatch.h"

namespace wetcloth_test {

/// A level square of 1 m x 1 m, n x n nodes.
inline wetcloth::ClothPatch squarePatch(int n) {
  wetcloth::ClothPatch patch;
  patch.columns = n;
  patch.rows = n;
  return patch;
}

/// An upright square of 1 m x 1 m, n x n nodes, pinned along its top edge.
inline wetcloth::ClothPatch hangingPatch(int n) {
  wetcloth::ClothPatch patch = squarePatch(n);
  patch.edgeV = btVector3(0, 1, 0);
  patch.pinnedEdges = {wetcloth::ClothPatch::Edge::top};
  return patch;
}

/// An upright square across the z axis, free, for wind along z.
inline wetcloth::ClothPatch sailPatch(int n) {
  wetcloth::ClothPatch patch = hangingPatch(n);
  patch.pinnedEdges.clear();
  return patch;
}

/// A square patch of n x n nodes in the plane y = 0, centred on the origin.
inline wetcloth::ClothPatch levelPatch(int n, double side, double arealDensity = 0.150) {
  wetcloth::ClothPatch patch;
  patch.columns = n;
  patch.rows = n;
  patch.origin = btVector3(btScalar(-side / 2), 0, btScalar(-side / 2));
  patch.edgeU = btVector3(btScalar(side), 0, 0);
  patch.edgeV = btVector3(0, 0, btScalar(side));
  patch.arealDensity = arealDensity;
  return patch;
}

}  // namespace wetcloth_test
