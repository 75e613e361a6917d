// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Effect.h"
#include "bullet_wetcloth/numerics/LinkSaturation.h"

#include <BulletSoftBody/btSoftBody.h>

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Relative change of a rest length, linear in saturation: saturatedStrain x saturation [-].
/// @param saturation  [0, 1]
WETCLOTH_EXPORT double swellingStrain(double saturation, double saturatedStrain);

/// Rest lengths by saturation: l = l0 (1 + strain), the same along warp and weft. Fibres that swell make yarns thicker,
/// and a woven cloth shorter; what dries gets its natural lengths l0 back, bit for bit.
///
/// Writes Link::m_rl and m_c1, which Bullet's position-based links, its springs in the deformable world and
/// HookeSprings all read. A rest length that the application changed is the link's new natural length, noticed when the
/// link's saturation next changes; btSoftBody::setRestLengthScale() scales the natural length. When Bullet takes the
/// present shape for the shape at rest (a body was cut, or setMass() was used), that is the shape of the wet cloth.
///
/// The shape that btSoftBody::setPose() remembered does not follow: a body with m_cfg.kMT > 0 is drawn back to it.
class WETCLOTH_EXPORT Swelling : public Effect {
 public:
  /// What can be set, with units and ranges. Checked when the effect is made, and by setParameters().
  struct Parameters {
    /// Relative change of length at saturation [-], (-0.5, 0.5); negative: shrinks. A yarn of ordinary twist gets 2 %
    /// shorter by the swelling of its cotton fibres (Collins 1939); a fabric that is wetted for the first time shrinks
    /// by more, and does not stretch back.
    double saturatedStrain = -0.02;
  };

  /// Throws std::invalid_argument naming the field and the value.
  explicit Swelling(Parameters parameters);

  /// As last set.
  const Parameters& parameters() const { return m_parameters; }
  /// Between steps, and all or nothing: throws as the constructor does, and then nothing has changed.
  void setParameters(Parameters parameters);

  const char* name() const override { return "Swelling"; }
  Stage stage() const override { return Stage::material; }
  /// Throws std::invalid_argument when the body has no links, or the cloth has a Swelling already.
  void attach(WetCloth& cloth) override;
  /// Gives the links their natural lengths back.
  void detach(WetCloth& cloth) override;
  void apply(WetCloth& cloth, const Step& step) override;
  void transferState(StateArchive& archive) override;

  /// Links visited so far: for tests that count work. A settled cloth adds none.
  long long linksVisited() const { return m_linksVisited; }

 private:
  struct Length {
    double natural;    // at saturation 0 [m]
    double factor;     // in force: 1 + strain
    btScalar written;  // the rest length that we last saw or wrote [m]
  };

  bool areAllOther(const btSoftBody& body) const;
  double factorOf(std::size_t link) const;
  void adoptReset(btSoftBody& body);
  void adoptChange(Length& length, btScalar found, bool wasScaled) const;
  void writeLengths(WetCloth& cloth);

  Parameters m_parameters;
  LinkSaturation m_saturation{5e-3};  // 0.01 % of a length at a strain of 2 %
  std::vector<Length> m_lengths;
  btScalar m_restLengthScale = 1;  // btSoftBody's, when we last looked
  bool m_isStale = true;
  bool m_lengthsWillBeReset = false;  // by Bullet, in the substep that we have just seen begin
  long long m_linksVisited = 0;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
