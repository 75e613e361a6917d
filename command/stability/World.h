// SPDX-License-Identifier: Zlib
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace stability {

/// Where a case runs.
enum class World {
  softRigid,
  softMultiBody,
  deformable,            ///< explicit; our HookeSprings hold the cloth, in plain Bullet its own springs do
  deformableImplicit,    ///< the same, implicit with projection
  softRigidClothSolver,  ///< soft-rigid, on ClothSolver; plain Bullet stays on its own solver
  softRigidGuard,        ///< the same with its guard, which the naive method goes without
  none                   ///< cases of pure computation
};

/// Who moves the cloth.
enum class Way {
  ours,            ///< Bullet and this library
  plainBullet,     ///< Bullet alone: the same bodies and whatever moves pins and bodies, no effect of ours
  plainBulletWet,  ///< the same with the masses of saturated cotton from the beginning
  naive            ///< Bullet, and what one would write first
};

inline const std::vector<std::pair<std::string, World>>& stabilityWorlds() {
  static const std::vector<std::pair<std::string, World>> names{
      {"soft_rigid", World::softRigid},
      {"soft_multibody", World::softMultiBody},
      {"deformable", World::deformable},
      {"deformable_implicit", World::deformableImplicit},
      {"soft_rigid_cloth_solver", World::softRigidClothSolver},
      {"soft_rigid_guard", World::softRigidGuard},
      {"none", World::none}};
  return names;
}

inline const std::string& nameOf(World world) {
  for (const auto& [name, value] : stabilityWorlds()) {
    if (value == world) return name;
  }
  return stabilityWorlds().back().first;
}

inline bool isDeformable(World world) { return world == World::deformable || world == World::deformableImplicit; }

}  // namespace stability
