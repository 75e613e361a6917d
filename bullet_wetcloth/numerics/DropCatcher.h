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

/// Water that a triangle catches of a stream [kg/s]: flux x projected area, both sides alike, flux |n . d| A.
/// Zero for a triangle without area, a direction of length 0, and values that are not finite.
/// @param direction  of the stream, of any length
/// @param flux       [kg/m^2/s] through an area across the stream
WETCLOTH_EXPORT double caughtFlux(const btVector3& a, const btVector3& b, const btVector3& c,
                                  const btVector3& direction, double flux);

/// What flying drops do when they meet a cloth, for every effect that makes them fly: a triangle gives what it caught
/// to its corners, a third each; a node takes what it has room for with the drops' velocity, and the rest strikes it
/// and runs off.
class WETCLOTH_EXPORT DropCatcher {
 public:
  using Triangle = std::array<int, 3>;

  /// Throws std::invalid_argument that names the effect when the body has no faces.
  void attach(const char* effect, const btSoftBody& body);

  const std::vector<Triangle>& triangles() const { return m_triangles; }
  /// Of the nodes, at the last begin() [m].
  const std::vector<btVector3>& positions() const { return m_positions; }
  btVector3 centroid(std::size_t triangle) const;

  /// A step begins: nothing caught, the nodes where they are now.
  void begin(const btSoftBody& body);
  /// A step in which nothing is caught.
  void skip() { m_caught = 0; }
  /// A triangle catches what flies in this direction (of length 1) with this velocity [m/s].
  /// @param perArea  [kg/m^2] across the stream. Ignored when what it comes to is not finite.
  void strike(std::size_t triangle, const btVector3& direction, double perArea, const btVector3& velocity);
  /// Gives what was caught to the nodes, of each its share when that is more than `most` [kg] together.
  void deliver(Water& water, double most);
  /// Water that struck the cloth in the last step [kg].
  double caught() const { return m_caught; }

  void transferState(StateArchive& archive);

 private:
  struct Drops {
    double mass = 0;                 // [kg]
    double momentum[3] = {0, 0, 0};  // [kg m/s]
  };

  std::vector<Triangle> m_triangles;
  std::vector<btVector3> m_positions;
  std::vector<Drops> m_drops;  // on each node
  NodeUptake m_uptake;
  double m_caught = 0;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
