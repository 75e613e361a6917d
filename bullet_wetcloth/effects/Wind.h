// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Effect.h"
#include "bullet_wetcloth/bullet/PackedNodes.h"
#include "bullet_wetcloth/effects/WindField.h"
#include "bullet_wetcloth/numerics/TriangleBlocks.h"
#include "bullet_wetcloth/numerics/TriangleDrag.h"

#include <BulletSoftBody/btSoftBody.h>

#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// The paper's wind force on a triangle (Basori et al. 2017, Fig. 6): n_hat (n_hat . wind), which has neither an
/// area nor the cloth's own motion in it. Zero for a triangle without area.
WETCLOTH_EXPORT btVector3 paperWindForce(const btVector3& a, const btVector3& b, const btVector3& c,
                                         const btVector3& wind);

/// Air's force on a triangle [N]: pressure x area along the normal, by the speed relative to the moving cloth,
/// F = 1/2 rho C_d A |u_n| u_n n_hat + 1/2 rho C_f A |u_t| u_t,  u = wind - velocity split into normal and tangent.
/// Zero for a triangle without area.
/// @param velocity  the triangle's own [m/s]
/// @param airDensity rho [kg/m^3]; @param dragCoefficient C_d [-]; @param skinFriction C_f [-]
WETCLOTH_EXPORT btVector3 quadraticWindForce(const btVector3& a, const btVector3& b, const btVector3& c,
                                             const btVector3& velocity, const btVector3& wind, double airDensity,
                                             double dragCoefficient, double skinFriction);

/// The same with a force linear in the relative speed [N]: F = k A u_n n_hat, k = linearDrag [N s/m^3].
WETCLOTH_EXPORT btVector3 linearWindForce(const btVector3& a, const btVector3& b, const btVector3& c,
                                          const btVector3& velocity, const btVector3& wind, double linearDrag);

/// Wind and air resistance on the cloth's triangles. Air at rest, the default, is wind too: it is drag.
///
/// Stands on its own beside Bullet's aerodynamics: a body whose m_cfg.kDG or kLF is set feels both; set them to 0
/// (Bullet's default) to feel only this.
class WETCLOTH_EXPORT Wind : public Effect {
 public:
  /// The force on a triangle.
  enum class Law {
    quadratic,  ///< 1/2 rho C_d A |u_n| u_n, a third to each corner
    linear,     ///< linearDrag A u_n, a third to each corner
    paper       ///< Fig. 6: n_hat (n_hat . wind) x paperForce, the whole force to each corner
  };
  /// How the force becomes a velocity.
  enum class Integration {
    semiImplicit,  ///< stable at any speed and step: the air never pushes a node past its own velocity
    explicitEuler  ///< for the comparison; overshoots on light nodes. Law::paper is always explicit
  };

  /// What can be set, with units and ranges. Checked when the effect is made, and by setParameters().
  struct Parameters {
    /// Velocity of the air [m/s]: a constant, or a function of position and time.
    WindField velocity = {};
    Law law = Law::quadratic;      ///< the force on a triangle
    double airDensity = 1.225;     ///< rho [kg/m^3], >= 0; dry air at 15 C and sea level
    double dragCoefficient = 1.2;  ///< C_d of a flat plate across the stream [-], >= 0
    double skinFriction = 0;       ///< C_f along the surface [-], >= 0
    double linearDrag = 0.256;     ///< k of Law::linear [N s/m^3], >= 0; 0.150 kg/m^2 / 0.585 s, see docs/paper.md
    /// Newtons per unit of the paper's wind vector, >= 0. The paper counts mass in grams, so its unit of force is
    /// 1 g m/s^2.
    double paperForce = 1e-3;
    Integration integration = Integration::semiImplicit;  ///< how it becomes a velocity
  };

  /// Throws std::invalid_argument naming the field and the value.
  explicit Wind(Parameters parameters);

  /// As last set.
  const Parameters& parameters() const { return m_parameters; }
  /// Between steps, and all or nothing: throws as the constructor does, and then nothing has changed.
  void setParameters(Parameters parameters);

  const char* name() const override { return "Wind"; }
  Stage stage() const override { return Stage::forces; }
  /// Throws std::invalid_argument when the body has no faces.
  void attach(WetCloth& cloth) override;
  bool usesPackedNodes() const override { return true; }
  void apply(WetCloth& cloth, const Step& step) override;
  /// When the air at the body's centre has changed by more than a tenth, or 0.1 m/s, since the last apply(); and in a
  /// wind of more than 0.1 m/s when other parameters than its velocity have.
  bool wakes(const WetCloth& cloth, const Step& step) const override;
  void transferState(StateArchive& archive) override;

  /// Force of the air per area on a triangle as it lies and moves now [Pa], before any integration; with Law::paper its
  /// three corners' together. Zero for a triangle without area. For a look at the wind: the step does not use it.
  /// @param time  simulated [s]
  btVector3 traction(const btSoftBody::Face& face, double time) const;

  /// Force of the air on the whole cloth in the last step [N].
  btVector3 totalForce() const { return m_totalForce; }

 private:
  using Lane = PackedNodes::Lane;

  btVector3 windAtCentre(const WetCloth& cloth, const Step& step) const;
  TriangleDrag::Nodes lanesOf(const PackedNodes& nodes);
  void spreadAreas(const PackedNodes& nodes);
  void look(const PackedNodes& nodes, const Step& step);
  void accumulate(const PackedNodes& nodes, const Step& step);
  void accumulateFriction(const PackedNodes& nodes, const Step& step);
  void accumulatePaper(const PackedNodes& nodes, const Step& step);
  void push(PackedNodes& nodes, const Step& step);
  template <class Action>
  void forEachTriangle(Action action) const;

  Parameters m_parameters;
  TriangleBlocks m_triangles;
  std::vector<btScalar> m_nodeAreas;  // when the effect was added, or the body last cut [m^2]
  bool m_areasAreStale = true;        // those of the slots
  // For each slot, and as many more as PackedNodes::kPadding:
  Lane m_areaInSlot;    // [m^2]
  Lane m_relative[3];   // velocity of the air relative to it [m/s]
  Lane m_specificArea;  // area over mass [m^2/kg], 0 when pinned
  Lane m_force[3];      // [N]
  Lane m_drag;          // force per relative speed, over all its triangles [kg/s]
  btVector3 m_totalForce = btVector3(0, 0, 0);
  btVector3 m_windAtCentre = btVector3(0, 0, 0);
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
