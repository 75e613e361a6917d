// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <LinearMath/btScalar.h>

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// The nodes of all cloths that are guarded, one after the other, with places relative to the first cloth's origin.
struct GuardNodes {
  struct Place {
    btScalar at[4];  ///< [m]; one more for the processor's sake
  };
  std::vector<Place> from;            ///< at the end of the small step before
  std::vector<Place> to;              ///< at the end of this one
  std::vector<Place> aside;           ///< how far of that they were moved without a change of velocity
  std::vector<btScalar> inverseMass;  ///< [1/kg]

  void resize(std::size_t count) {
    from.resize(count);
    to.resize(count);
    aside.resize(count);
    inverseMass.resize(count);
  }
  bool isImposed(int node) const { return !(inverseMass[static_cast<std::size_t>(node)] > 0); }
};

/// Nodes of two parts that must not meet: of a vertex and a face, or of two edges.
struct GuardPair {
  int node[4];  ///< among GuardNodes
};

/// Pairs that may meet.
struct GuardCandidates {
  std::vector<GuardPair> vertexFace;  ///< the vertex first
  std::vector<GuardPair> edgeEdge;

  void clear() {
    vertexFace.clear();
    edgeEdge.clear();
  }
  std::size_t size() const { return vertexFace.size() + edgeEdge.size(); }
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
