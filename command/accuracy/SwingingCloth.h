// SPDX-License-Identifier: Zlib
#pragma once

#include "command/accuracy/MassSpringReference.h"
#include "command/accuracy/Specimen.h"
#include "command/scene/Scene.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace accuracy {

/// A cloth of 1 m x 1 m that hangs from its pinned upper edge, along the z axis, out of the vertical by `angle`: to be
/// let go.
struct SwingingCloth {
  static constexpr int side = 25;            ///< nodes
  static constexpr double length = 1;        ///< [m]
  static constexpr double stiffness = 1000;  ///< of its springs [N/m]
  static constexpr double bendingStiffness = 10;
  static constexpr double gravity = 9.81;

  double angle = 0;  ///< out of the vertical [rad]

  wetcloth::ClothPatch patch() const;
  MassSpringReference reference() const;
};

/// Which forces hold a cloth in Bullet together, and how finely.
struct ClothSolver {
  enum class Kind { links, smallSteps, hookeSprings, deformableExplicit, deformableImplicit };
  Kind kind = Kind::links;
  int substeps = 4;     ///< of 1/60 s
  int iterations = 10;  ///< of Bullet's links and of HookeSprings; small steps in 1/60 s of ClothSolver

  double substep() const { return 1. / 60 / substeps; }
};

/// Where a cloth's mass is, again and again.
struct ClothRecord {
  std::vector<double> times;     ///< [s]
  std::vector<double> across;    ///< of the centre of mass [m]
  std::vector<double> heights;   ///< of the centre of mass [m], below 0
  std::vector<double> lowest;    ///< mean height of the lower edge [m]
  std::vector<double> energies;  ///< kinetic and of gravity, over mass [J/kg]
  double seconds = 0;            ///< processor time
  bool isFinite = true;
};

ClothRecord record(const SwingingCloth& cloth, const ClothSolver& solver, double duration);
/// @param dt of the reference [s]
ClothRecord recordReference(const SwingingCloth& cloth, double dt, double duration);

/// Mean height of the lower edge from half of the time on, below where it hangs unstretched [m].
double sagOf(const ClothRecord& record);
/// Of the swing, from the times at which the centre of mass passes below the pins [s]; not finite when it does so less
/// than three times.
double periodOf(const ClothRecord& record);
/// Mean energy of the last quarter over that of the first record, both above the lowest possible one of a cloth that
/// does not stretch, less 1 [-].
double energyDriftOf(const ClothRecord& record);

}  // namespace accuracy
