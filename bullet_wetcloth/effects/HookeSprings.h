// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Effect.h"

#include <BulletSoftBody/btSoftBody.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class SpringSolver;
struct Spring;
struct SpringNode;

/// Force of a spring on its end `a` [N] (Basori et al. 2017, Eq. 5 and 6 with the unit vector that Eq. 6 lost):
/// K (|b - a| - l0) along b - a. Zero when the ends coincide.
/// @param restLength l0 [m]; @param stiffness K [N/m]
WETCLOTH_EXPORT btVector3 hookeForce(const btVector3& a, const btVector3& b, double restLength, double stiffness);

/// Makes the links true springs, so that a cloth stretches under its weight, wet more than dry.
///
/// Bullet's position-based links do not stretch under a uniform change of mass. This takes their place: the links
/// stay where they are (collision, drawing and cutting go on using them) but stop pulling, and the springs' forces
/// enter as velocity changes by backward Euler: a step of Newton's method, solved by a few conjugate gradients, with
/// one sparse factorisation for very many steps as their preconditioner (the matrix of Liu et al. 2013, "Fast
/// simulation of mass-spring systems"). It is made anew when a node was freed or held, or when m / dt^2 of a node or K
/// of a spring has doubled or halved: a cloth that soaks to 1.84 times its mass keeps it. Stable for any stiffness and
/// step; one above 1e10 m / dt^2, of the heaviest node, is taken for that. Anchored nodes follow their rigid body,
/// which feels the pull.
///
/// Works in all three worlds. In the deformable world Bullet has springs of its own (btDeformableMassSpringForce):
/// use those or this, not both.
///
/// K follows LinkConstants::setStiffness(), which WetStiffness sets, in whatever order the two are added.
class WETCLOTH_EXPORT HookeSprings : public Effect {
 public:
  /// What can be set, with units and ranges. Checked when the effect is made, and by setParameters().
  struct Parameters {
    double stiffness = 1000;       ///< K of the links [N/m], (0, inf)
    double bendingStiffness = 10;  ///< K of links that are marked as bending (flexion springs) [N/m], [0, inf)
    /// K of each link [N/m], in the order of btSoftBody::m_links; empty: the two values above.
    std::vector<double> perLink = {};
    /// Of conjugate gradients in a substep, >= 1. A cloth at rest needs no more than one. A light cloth of 1 m (150
    /// g/m^2, 25 x 25 nodes, K = 1 kN/m) that swings has its period to 1 % with 3 at 1/120 s, and with 8 at 1/60 s.
    /// Longer steps, stiffer springs, lighter nodes and finer meshes take more.
    int iterations = 3;
  };

  /// Throws std::invalid_argument naming the field and the value.
  explicit HookeSprings(Parameters parameters);
  ~HookeSprings() override;

  /// As last set.
  const Parameters& parameters() const { return m_parameters; }
  /// Between steps, and all or nothing: throws as the constructor does, or when `perLink` has not one value per link,
  /// and then nothing has changed.
  void setParameters(Parameters parameters);

  const char* name() const override { return "HookeSprings"; }
  Stage stage() const override { return Stage::elasticity; }
  /// Throws std::invalid_argument when the body has no links, the cloth has HookeSprings already, or `perLink` has not
  /// one value per link.
  void attach(WetCloth& cloth) override;
  void detach(WetCloth& cloth) override;
  void apply(WetCloth& cloth, const Step& step) override;
  void transferState(StateArchive& archive) override;

  /// How often the matrix was factored: for tests that count work.
  long long factorizations() const;

 private:
  static constexpr unsigned long long kUnscaled = ~0ULL;  // the springs have not seen the links' factors yet

  double stiffnessOf(const btSoftBody::Link& link, std::size_t index) const;
  void disableLinks(WetCloth& cloth);
  void scaleStiffness(WetCloth& cloth);
  void gather(const btSoftBody& body, const Step& step);
  void followAnchors(btSoftBody& body, const Step& step);
  void pullAnchors(btSoftBody& body, const std::vector<Spring>& springs, const Step& step);
  const std::vector<Spring>& limitedSprings(double dt);

  Parameters m_parameters;
  std::unique_ptr<SpringSolver> m_solver;  // behind a pointer, so that Eigen stays out of this header
  std::vector<Spring> m_springs;
  std::vector<Spring> m_limitedSprings;  // the same, none so stiff that masses would be lost beside it
  std::vector<SpringNode> m_nodes;
  unsigned long long m_stiffnessRevision = kUnscaled;  // of LinkConstants::setStiffness()
  btSoftBody::Material* m_powerless = nullptr;         // appended to the body, which owns it
  std::vector<btSoftBody::Material*> m_ownMaterials;   // of each link before us
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
