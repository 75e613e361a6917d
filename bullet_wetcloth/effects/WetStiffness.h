// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Effect.h"
#include "bullet_wetcloth/bullet/PackedNodes.h"
#include "bullet_wetcloth/numerics/LinkSaturation.h"

#include <LinearMath/btVector3.h>

#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Factor on the stiffness of a link, linear in its saturation: 1 + (atSaturation - 1) saturation.
/// @param saturation  [0, 1]; @param atSaturation  the factor at saturation 1, > 0
WETCLOTH_EXPORT double wetStiffnessFactor(double saturation, double atSaturation);

/// Share of the relative velocity along a link that is lost in dt, exact for any dt: 1 - exp(-rate dt), from
/// du/dt = -rate u. @param rate [1/s], >= 0; @param dt [s]
WETCLOTH_EXPORT double dampingShare(double rate, double dt);

/// Impulse on node b of a link, and the opposite on node a, that takes `share` of the nodes' relative velocity along it
/// [kg m/s]: share u (b - a) / (|b - a|^2 (1/m_a + 1/m_b)) with u = (v_a - v_b) . (b - a). A partly inelastic impact:
/// energy falls by (1 - (1 - share)^2) of that of the relative motion, and never grows for a share in [0, 1]. Zero when
/// the ends coincide or neither can move. @param ab  b - a [m]; @param velocity  v_b - v_a [m/s];
/// @param inverseMasses  1/m_a + 1/m_b [1/kg], 0 for a pinned end
WETCLOTH_EXPORT btVector3 dampingImpulse(const btVector3& ab, const btVector3& velocity, btScalar inverseMasses,
                                         btScalar share);

/// What water does to the stiffness of the links, stretching and bending, and to the damping along them. Each link goes
/// by its own saturation, the mean of its nodes', and no material is touched: other bodies may share it.
///
/// What a factor on the stiffness means depends on what holds the cloth together:
/// - HookeSprings, in any world: the springs' K [N/m] is multiplied. Add the two in any order, except in the deformable
///   world.
/// - Bullet's position-based links: the share k = kLST of its error that a link takes back in each of
///   btSoftBody::m_cfg.piterations is multiplied, up to 1. A single link that holds a weight sags by
///   g dt^2 (1 - k)^n / (1 - (1 - k)^n) after n iterations, whatever the weight: at k = 0.5 and n = 10 a thousandth of
///   g dt^2. In a net, where each link waits for many others, the sag that the iterations leave anyhow grows about as
///   (2 - k) / k: three times at k = 0.5. So a factor softens, but is no material constant: what it does depends on
///   n, dt and the mesh, and where the iterations converge it does nothing.
/// - Bullet's own springs in the deformable world (btDeformableMassSpringForce) have one stiffness for all links and
///   read none per link: attach() refuses factors other than 1 there, unless HookeSprings were added before. (Once
///   those are removed again, the factors have nothing to act on.)
///
/// Damping acts in every world, HookeSprings or not.
class WETCLOTH_EXPORT WetStiffness : public Effect {
 public:
  /// What can be set, with units and ranges. Checked when the effect is made, and by setParameters().
  struct Parameters {
    double wetStretch = 0.8;  ///< factor on the stiffness of structural links at saturation, [0.001, 1000]; a guess
    double wetBending = 0.5;  ///< factor on that of links marked as bending at saturation, [0.001, 1000]; a guess
    double dryDamping = 0;    ///< rate at which relative velocity along a dry link decays [1/s], [0, inf)
    double wetDamping = 0;    ///< the same along a saturated one [1/s], [0, inf); linear in saturation between them
  };

  /// Throws std::invalid_argument naming the field and the value.
  explicit WetStiffness(Parameters parameters);

  /// As last set.
  const Parameters& parameters() const { return m_parameters; }
  /// Between steps, and all or nothing: throws as the constructor does, or attach() of a factor that is not 1, and then
  /// nothing has changed. Links whose factors become 1 have the constants again that Bullet would compute.
  void setParameters(Parameters parameters);

  const char* name() const override { return "WetStiffness"; }
  Stage stage() const override { return Stage::material; }
  /// Throws std::invalid_argument when the body has no links, the cloth has a WetStiffness already, or it is in the
  /// deformable world, has no HookeSprings yet, and a factor is not 1.
  void attach(WetCloth& cloth) override;
  /// Gives the links the constants that Bullet would compute.
  void detach(WetCloth& cloth) override;
  void apply(WetCloth& cloth, const Step& step) override;
  void transferState(StateArchive& archive) override;

  /// Links visited so far: for tests that count work. A settled cloth without damping adds none.
  long long linksVisited() const { return m_linksVisited; }

 private:
  bool scales() const { return scales(m_parameters); }
  static bool scales(const Parameters& parameters) { return parameters.wetStretch != 1 || parameters.wetBending != 1; }
  bool damps() const { return m_parameters.dryDamping > 0 || m_parameters.wetDamping > 0; }
  void requireScalable(const WetCloth& cloth, const Parameters& parameters) const;
  void scaleLinks(WetCloth& cloth);
  void updateShares(double dt);
  void weigh(const WetCloth& cloth, const PackedNodes& nodes);
  void damp(WetCloth& cloth);

  Parameters m_parameters;
  WetCloth* m_cloth = nullptr;
  LinkSaturation m_saturation{1e-3};
  std::vector<btScalar> m_factors;      // on the stiffness of each link; empty when none is scaled
  std::vector<btScalar> m_inverseMass;  // of each node with the water that has come to it [1/kg]
  std::vector<btScalar> m_shares;       // of the relative velocity along each link, lost in a step
  double m_sharesDt = 0;                // the step that they were computed for, 0: none
  bool m_factorsAreStale = true;
  bool m_constantsWillBeReset = false;  // by Bullet, in the substep that we have just seen begin
  long long m_linksVisited = 0;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
