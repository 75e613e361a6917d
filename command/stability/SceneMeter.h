// SPDX-License-Identifier: Zlib
#pragma once

#include "command/stability/CaseMeter.h"
#include "command/stability/CaseScene.h"

namespace stability {

/// Measures a scene against its limits. The bounds, and why they are physics:
/// - `finite`: every position, velocity and amount of water is a number;
/// - `energy`: kinetic energy is at most all mass moving as fast as the fastest source and a fall through the whole
///   drop, 1/2 M (u + v)^2, v = sqrt(2 g h) and one step's gravity: nothing else puts energy in;
/// - `speed`: `Limits::whip` times that speed for any one node, twice as a rule, since a free edge doubles the velocity
///   of a wave that reaches it;
/// - `stretch`: a link is longer than at rest by at most `Limits::stretch` of itself, its springs' static stretch, and
///   what its two ends part in one step at full speed, before the next solve can see it;
/// - `ledger`: initial + absorbed = held + dripped + evaporated to 1e-12 of what was booked, and no node holds less
/// than
///   nothing or more than it can;
/// - `rest`: after the calm, kinetic energy is below a hundredth of what falling through the drop gives, or, where
/// there
///   is no weight, of what the fastest source gave;
/// - `final stretch`: after the calm, no link is longer than at rest by more than a tenth and its static stretch.
class SceneMeter {
 public:
  SceneMeter(CaseScene& scene, CaseMeter& meter) : m_scene(scene), m_meter(meter) {}

  /// After each step. False when the run is over: a number is not finite, or kinetic energy is 10^4 times what is
  /// allowed. From much more than that Bullet's own cubic solver never returns (docs/bullet_notes.md).
  bool observe();
  /// After the last step.
  void finish();
  /// Instead, when the run was over before: it never came to rest.
  void giveUp();

 private:
  double topSpeed() const;
  bool observeMotion(const CaseScene::Cloth& cloth);
  void observeLinks(const CaseScene::Cloth& cloth, const char* bound, double share, double travel);
  void observeWater(const CaseScene::Cloth& cloth);

  CaseScene& m_scene;
  CaseMeter& m_meter;
  double m_kineticEnergy = 0;  // of all cloths at the last look [J]
  double m_mass = 0;           // of the free nodes [kg]
};

}  // namespace stability
