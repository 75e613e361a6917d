// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/bullet/PackedNodes.h"
#include "bullet_wetcloth/numerics/FluidResistance.h"
#include "bullet_wetcloth/numerics/TriangleBlocks.h"

#include <LinearMath/btVector3.h>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// The push of a fluid along the normals of triangles that move through it.
///
/// Each corner is pushed by its own relative velocity: then the fluid can only bring a node closer to its own velocity.
/// With N the normal times twice the area and resistance R, the force on a corner is R (N . u) N / (6 |N|).
struct TriangleDrag {
  /// One number for each node, and as many more as PackedNodes::kPadding.
  struct Nodes {
    const btScalar* position[3];   ///< [m]
    const btScalar* relative[3];   ///< velocity of the fluid relative to the node [m/s]
    const btScalar* specificArea;  ///< area over mass [m^2/kg], 0 when pinned
    btScalar* force[3];            ///< is added to [N]
    btScalar* drag;                ///< force per relative speed, is added to [kg/s]
  };
  /// What is added to the relative velocity of all corners of a triangle, by axis and lane [m/s].
  using Flow = btScalar[3][TriangleBlocks::kSize];

  /// Adds the forces of a block's triangles. @param flow  null: there is none
  static void add(const TriangleBlocks& triangles, const TriangleBlocks::Block& block,
                  const FluidResistance& resistance, const Flow* flow, const Nodes& nodes);

  /// The step of the velocities.
  struct Step {
    btScalar dt;          ///< [s]
    btScalar implicitDt;  ///< dt, or 0: explicit
  };
  /// Changes the velocities by the forces, and returns their sum [N]. With s >= the largest eigenvalue of the node's
  /// drag tensor D, v' - w = (I - dt D / (m + dt s)) (v - w) never lengthens the difference to the fluid's velocity w,
  /// for any mass and step; on a flat sheet it is backward Euler. A node whose force is not finite is left alone.
  static btVector3 push(const Nodes& forces, PackedNodes& nodes, const Step& step);
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
