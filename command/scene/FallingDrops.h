// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/Scene.h"

#include <vector>

namespace command {

/// A sphere of water.
struct FallingDrop {
  btVector3 position;
  double radius;  ///< [m]
};

/// Drops that have fallen from a scene's cloths, on their way to the ground or to the water: in a vacuum, for the
/// second or less that it takes.
class FallingDrops {
 public:
  explicit FallingDrops(const Scene& scene);
  FallingDrops(const FallingDrops&) = delete;
  FallingDrops& operator=(const FallingDrops&) = delete;

  /// Takes this effect's drops from now on. Must outlive the effect.
  void follow(wetcloth::Dripping& dripping);
  /// Forgets those that have landed by `time` [s], or that fell three seconds ago.
  void forgetLanded(double time);
  /// Spheres of the drops' water, where they are at `time` [s].
  std::vector<FallingDrop> at(double time) const;

 private:
  struct Fall {
    double start;  // [s]
    btVector3 position;
    btVector3 velocity;
    double radius;  // [m]
  };

  btVector3 positionOf(const Fall& fall, double time) const;
  bool hasLanded(const Fall& fall, double time) const;

  btVector3 m_gravity;
  double m_waterDensity;
  std::vector<Plane> m_floors;  // the water's surface among them
  std::vector<Fall> m_falls;
};

}  // namespace command
