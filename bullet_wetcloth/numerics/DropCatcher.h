// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/numerics/Direction.h"
#include "bullet_wetcloth/numerics/NodeUptake.h"
#include "bullet_wetcloth/water/Water.h"

#include <BulletSoftBody/btSoftBody.h>

#include <array>
#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Water that a triangle catches from a stream of drops [kg/s]: flux |n . d| A, with n the triangle's normal, A its
/// area and d the stream's direction, both of length 1. Both sides of the triangle catch alike. Zero for a triangle
/// without area, a direction of length 0, and values that are not finite.
/// @param direction  of the stream, of any length
/// @param flux       [kg/m^2/s] through an area across the stream
WETCLOTH_EXPORT double caughtFlux(const btVector3& a, const btVector3& b, const btVector3& c,
                                  const btVector3& direction, double flux);

/// What happens to flying drops that meet a cloth: a member of each effect with flying drops.
///
/// A step is begin(), a strike() for each triangle that drops meet, and deliver(). A triangle shares what it caught
/// among its corners, a third each. A node takes up what it has room for, and with it the drops' momentum. The rest
/// gives the node its momentum, too, and runs off.
class WETCLOTH_EXPORT DropCatcher {
 public:
  /// Its three nodes.
  using Triangle = std::array<int, 3>;

  /// Throws std::invalid_argument that names the effect when the body has no faces.
  void attach(const char* effect, const btSoftBody& body);

  /// The body's faces, as attached; a face that is there twice, either way round, once.
  const std::vector<Triangle>& triangles() const { return m_triangles; }
  /// Where the nodes were at the last begin() [m].
  const std::vector<btVector3>& positions() const { return m_positions; }
  /// Of a triangle, at the last begin() [m].
  btVector3 centroid(std::size_t triangle) const;

  /// Begins a step: nothing is caught yet, and the nodes are where the body has them now.
  void begin(const btSoftBody& body);
  /// Takes the place of begin() to deliver() in a step in which no drops fly.
  void skip() { m_caught = 0; }
  /// A triangle catches the drops of this step.
  /// @param direction  in which they fly, of length 1; @param velocity  of the drops [m/s]
  /// @param perArea    water through an area across the stream in this step [kg/m^2]
  /// What would be no finite mass or momentum is ignored.
  void strike(std::size_t triangle, const btVector3& direction, double perArea, const btVector3& velocity);
  /// Gives the nodes what was caught. When that is more than `most` [kg] in all, each node gets the same fraction less.
  void deliver(Water& water, double most);
  /// Water that struck the cloth in the last step [kg].
  double caught() const { return m_caught; }

  /// Names what goes on from step to step: see StateArchive.
  void transferState(StateArchive& archive);

 private:
  struct Drops {
    double mass = 0;                 // [kg]
    double momentum[3] = {0, 0, 0};  // [kg m/s]
  };

  std::vector<Triangle> m_triangles;
  std::vector<btVector3> m_positions;
  std::vector<Drops> m_drops;  // that struck each node in this step
  NodeUptake m_uptake;
  double m_caught = 0;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
