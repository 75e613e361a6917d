// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Effect.h"
#include "bullet_wetcloth/numerics/WetnessCurve.h"

#include <BulletSoftBody/btSoftBody.h>

#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

struct ContactPoint;
struct RigidContact;

/// What Bullet's position-based worlds write into a contact of a node with a rigid body: the share of the tangential
/// motion that is left to it. That is 0 when the motion is inside the friction cone, |v_t| < mu |v_n|, and 1 - mu
/// outside of it, so a coefficient of 1 and more holds the node fast.
/// @param friction  mu, of both bodies together [-], >= 0; above 1 it counts as 1: more would turn the motion round
/// @param normal, tangential  the node's motion in the substep relative to the body, in two parts
WETCLOTH_EXPORT btScalar slidingShare(btScalar friction, btScalar normal, const btVector3& tangential);

/// Friction by the wetness of what touches: the coefficient that Bullet combined for a contact is multiplied by a
/// factor that goes from 1 (dry) to `wetFactor` at `peakSaturation` and on to `floodedFactor` at saturation 1.
///
/// Works on the contacts that Bullet has found, at the stage `contact`; m_cfg.kDF and the other bodies' friction stay
/// as they are. The dynamic friction coefficient kDF of this body counts as kDF x factor in Bullet's own rule:
/// kDF x the object's friction for rigid bodies; for two soft bodies, in the position-based worlds, the larger of the
/// two, each with the factor of its own WetFriction. What the deformable world does between two soft bodies, it finds
/// and applies after its solve, where nobody can reach it.
///
/// Between layers that the guard of a ClothSolver keeps apart, of two cloths or of one, the coefficient is the guard's
/// own (ClothGuardParameters::friction) times the larger of the two factors.
class WETCLOTH_EXPORT WetFriction : public Effect {
 public:
  /// What can be set, with units and ranges. Checked when the effect is made, and by setParameters().
  struct Parameters {
    double wetFactor = 2.5;       ///< at peakSaturation [-], [0, inf)
    double peakSaturation = 0.5;  ///< (0, 1]
    double floodedFactor = 2;     ///< at saturation 1 [-], [0, inf); unused when peakSaturation is 1
  };

  /// Throws std::invalid_argument naming the field and the value.
  explicit WetFriction(Parameters parameters);

  /// As last set.
  const Parameters& parameters() const { return m_parameters; }
  /// Between steps, and all or nothing: throws as the constructor does, and then nothing has changed.
  void setParameters(Parameters parameters);

  /// The factor at a saturation.
  double factor(double saturation) const { return m_curve.at(saturation); }

  const char* name() const override { return "WetFriction"; }
  Stage stage() const override { return Stage::contact; }
  /// Throws std::invalid_argument when Bullet lists none of this body's contacts, with the reason.
  void attach(WetCloth& cloth) override;
  void detach(WetCloth& cloth) override;
  void apply(WetCloth& cloth, const Step& step) override;
  void transferState(StateArchive& archive) override;

  /// Contacts changed so far: for tests that count work.
  long long contactsVisited() const { return m_contactsVisited; }

 private:
  double factorAt(const WetCloth& cloth, const ContactPoint& point) const;
  void changeRigid(const WetCloth& cloth, const RigidContact& contact);
  void changeSoft(WetCloth& cloth, btSoftBody& other);
  void changeLayers(WetCloth& cloth);

  Parameters m_parameters;
  WetnessCurve m_curve;
  bool m_hasFaceContacts = false;
  std::vector<btScalar> m_factors;  // by node
  long long m_contactsVisited = 0;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
