// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/CrossingContours.h"
#include "bullet_wetcloth/solver/CrossingExemptions.h"
#include "bullet_wetcloth/solver/Crossings.h"

#include <LinearMath/btVector3.h>

#include <array>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Draws cloths that cross out of each other: intersection contour minimization (Volino and Magnenat-Thalmann 2006,
/// "Resolving surface collisions through intersection contour minimization").
///
/// Each edge that goes through a face is moved against it along the direction in which the curve where the cloths cross
/// gets shorter, and the face the other way; what all of a curve's crossings agree upon counts for each of them. They
/// are moved aside, slowly and without a change of velocity, as far as they do not come apart by themselves; velocities
/// that drive them further into each other are taken away. So momentum does not change.
class Untangling {
 public:
  /// Before the first small step: what crosses now, of these cloths.
  void begin(const std::vector<Crossing>& crossings, const std::vector<ClothGuard::Cloth>& cloths);
  /// Nothing is to be drawn apart.
  void clear() { begin({}, {}); }
  /// After all cloths' small step, and before the guard's.
  void push(const std::vector<ClothGuard::Cloth>& cloths);
  /// What the guard leaves alone meanwhile.
  const CrossingExemptions& exemptions() const { return m_exemptions; }

 private:
  // A crossing in this step, as it was last; it may have come apart.
  struct Pair {
    Crossing crossing;
    std::array<btScalar, 5> weight;  // of the edge's nodes and of the face's, which are negative
    btVector3 gradient;              // in which the edge goes, so that the curve gets shorter
    bool isCrossing;
  };
  // What a pair is moved by.
  struct Grip {
    std::array<int, 5> nodes;  // among all
    std::array<std::size_t, 5> slots;
    std::array<btScalar, 5> shares;  // of a way between the edge and the face that each node goes
    btScalar yield;                  // 0: none can be moved
    btVector3 way;                   // that the edge goes from the face by itself in this small step [m]
    btVector3 aside;                 // and was moved so far [m]
    btScalar most;                   // that it may be moved [m]
  };
  // A direction, and how much that shortens the curve, [0, 1).
  struct Pull {
    explicit Pull(const btVector3& gradient);
    btVector3 direction;
    btScalar size;
  };

  void aim(Pair& pair, const std::vector<ClothGuard::Cloth>& cloths) const;
  void sumUp();
  btVector3 ofContour(std::size_t pair) const;
  Grip gripOf(const Pair& pair, const std::vector<ClothGuard::Cloth>& cloths) const;
  void drawApart(const Pair& pair, const btVector3& ofContour, const std::vector<ClothGuard::Cloth>& cloths);

  std::vector<Pair> m_pairs;
  CrossingContours m_contours;
  // Of each contour.
  struct Sum {
    btVector3 gradient;
    btScalar size;  // of all gradients
  };
  std::vector<Sum> m_sums;
  std::vector<Sum> m_newSums;
  std::vector<int> m_first;        // node of each cloth
  std::vector<btVector3> m_aside;  // how far each node was moved so in this small step [m]
  CrossingExemptions m_exemptions;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
