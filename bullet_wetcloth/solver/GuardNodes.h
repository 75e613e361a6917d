// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <LinearMath/btVector3.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// The nodes of all cloths that are guarded, one after the other, with places relative to the first cloth's origin. The
/// last may be those of rigid bodies.
///
/// Until the next look at all of them a node is expected on the straight way from its start to its end, or no further
/// from there than its slack on each axis.
struct GuardNodes {
  struct Place {
    btScalar at[4];  ///< [m]; the last one is the slack of what is expected, else for the processor's sake
  };
  struct Way {
    Place start;
    Place end;
  };
  std::vector<Place> from;  ///< at the end of the small step before
  std::vector<Place> to;    ///< at the end of this one
  std::vector<Way> expected;
  std::vector<Place> aside;           ///< how far of that they were moved without a change of velocity
  std::vector<btScalar> inverseMass;  ///< [1/kg]
  /// Factor of friction by wetness; none at all: 1.
  std::vector<btScalar> friction;
  int firstOfBodies = std::numeric_limits<int>::max();
  /// Of each node of bodies, from firstOfBodies on: what it has pushed in this small step, the other way [kg m], and
  /// times how far [kg m^2].
  std::vector<Place> recoil;

  void resize(std::size_t count) {
    from.resize(count);
    to.resize(count);
    expected.resize(count);
    aside.resize(count);
    inverseMass.resize(count);
  }
  /// After resize(): from this node on they are those of bodies.
  void setBodies(std::size_t first) {
    firstOfBodies = static_cast<int>(first);
    recoil.assign(to.size() - first, {});
  }
  /// As dry cloths have it; bodies have none of their own.
  void startFriction() {
    if (!friction.empty()) return;
    friction.resize(to.size(), 1);
    for (std::size_t k = 0; k < recoil.size(); ++k) friction[static_cast<std::size_t>(firstOfBodies) + k] = 0;
  }
  bool isOfBodies(int node) const { return node >= firstOfBodies; }
  /// A node of a body has pushed something.
  /// @param push  what that has gained [kg m], over this way [m]
  void addRecoil(int node, const btVector3& push, btScalar way) {
    Place& sum = recoil[static_cast<std::size_t>(node - firstOfBodies)];
    for (int axis = 0; axis < 3; ++axis) sum.at[axis] -= push[axis];
    sum.at[3] += push.length() * way;
  }
  bool isImposed(int node) const { return !(inverseMass[static_cast<std::size_t>(node)] > 0); }
};

/// Nodes of two parts that must not meet: of a vertex and a face, or of two edges.
struct GuardPair {
  int node[4];  ///< among GuardNodes
  int tile[2];  ///< of GuardTiles, in which the two parts were found
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
  bool isEmpty() const { return size() == 0; }
  /// Takes out the pairs of which some node of the first part and some of the second are so.
  template <class AreSo>
  void removeIfAny(const AreSo& areSo) {
    const auto removeFrom = [&areSo](std::vector<GuardPair>& pairs, int firstNodes) {
      const auto isSo = [&](const GuardPair& pair) {
        for (int i = 0; i < firstNodes; ++i) {
          for (int k = firstNodes; k < 4; ++k) {
            if (areSo(pair.node[i], pair.node[k])) return true;
          }
        }
        return false;
      };
      pairs.erase(std::remove_if(pairs.begin(), pairs.end(), isSo), pairs.end());
    };
    removeFrom(vertexFace, 1);
    removeFrom(edgeEdge, 2);
  }
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
