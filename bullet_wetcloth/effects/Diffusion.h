// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Effect.h"
#include "bullet_wetcloth/numerics/SteadyState.h"

#include <LinearMath/btVector3.h>

#include <memory>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class DiffusionSolver;
class DiffusionStep;
class EdgeFlow;

/// Diffusivity at a saturation over that at saturation 1: s^exponent [-], of a saturation in [0, 1].
WETCLOTH_EXPORT double relativeDiffusivity(double saturation, double exponent);

/// Its integral from 0 (Kirchhoff 1894): Phi(s) = s^(exponent + 1) / (exponent + 1) [-], whose gradient drives the
/// flow.
WETCLOTH_EXPORT double diffusionPotential(double saturation, double exponent);

/// Wicking: water spreads over the cloth from wet to dry.
///
/// c ds/dt = div(c D(s) grad s), s saturation, c capacity per area, D(s) = D s^exponent with a D for the warp and one
/// for the weft (Richards 1931 without gravity; Fick's law for exponent 0). With an exponent > 0 water enters dry cloth
/// behind a front that advances as sqrt(t) (Washburn 1921).
///
/// Over the triangles at rest, with cotangent weights made Delaunay (delaunayWeights()), so that a bent cloth wicks
/// like a flat one and obtuse triangles do no harm. Conserves water to rounding, and keeps every node between empty and
/// full, for any step. Water takes the velocity of the node that it leaves.
class WETCLOTH_EXPORT Diffusion : public Effect {
 public:
  /// How a step is solved.
  enum class Method {
    /// Implicit, of second order in time, one sparse factorisation for many steps: a step is two solves. Stable for any
    /// step, in which no node becomes drier than the driest or wetter than the wettest.
    factored,
    /// The same step by conjugate gradients: no factor to make and to store, more time per step.
    conjugateGradients,
    /// Explicit, in as many substeps as it needs, 1000 at most; beyond those bounded, but no longer accurate. Of first
    /// order in the substep, which is as short as the mesh width squared, and so is no more wrong than the mesh.
    explicitSubsteps
  };

  /// What can be set, with units and ranges. Checked when the effect is made, and by setParameters().
  struct Parameters {
    double warpDiffusivity = 5e-6;  ///< D of a saturated cloth along the warp [m^2/s], > 0. The default is a guess
    double weftDiffusivity = 5e-6;  ///< and along the weft [m^2/s], > 0. The default is a guess
    double exponent = 2;  ///< of D(s) = D s^exponent [-], in [0, 100]; 2 goes with 3 in Seepage (Brooks & Corey 1964)
    /// Direction of the warp, of any length > 0, in the body's shape when the effect is added, or when the direction is
    /// changed; projected onto each triangle. Matters only when the two diffusivities differ.
    btVector3 warp = btVector3(1, 0, 0);
    Method method = Method::factored;  ///< how a step is solved
    double tolerance = 1e-8;  ///< of Method::conjugateGradients: residual over that of even water [-], in (0, 1)
  };

  /// Throws std::invalid_argument naming the field and the value.
  explicit Diffusion(Parameters parameters);
  ~Diffusion() override;

  /// As last set.
  const Parameters& parameters() const { return m_parameters; }
  /// Between steps, and all or nothing: throws as the constructor does, and then nothing has changed. Other
  /// diffusivities or another warp take the time that adding the effect took.
  void setParameters(Parameters parameters);

  const char* name() const override { return "Diffusion"; }
  Stage stage() const override { return Stage::transport; }
  /// Throws std::invalid_argument when the body has no faces.
  void attach(WetCloth& cloth) override;
  void detach(WetCloth& cloth) override;
  void apply(WetCloth& cloth, const Step& step) override;
  void transferState(StateArchive& archive) override;

  /// Nodes visited so far: for tests that count work, as are the next four. A settled cloth adds none.
  long long nodesVisited() const { return m_nodesVisited; }
  /// Linear systems solved.
  long long solves() const;
  /// Matrices factored.
  long long factorizations() const;
  /// Explicit substeps.
  long long substeps() const { return m_substeps; }
  /// Iterations of conjugate gradients.
  long long iterations() const;

 private:
  void conductAs(const Parameters& parameters);
  void layEdges();
  void rememberWarp(WetCloth& cloth);
  void flowInOneStep(double dt);
  void setPotential();
  void flowInSubsteps(double dt);

  Parameters m_parameters;
  WetCloth* m_cloth = nullptr;
  std::unique_ptr<EdgeFlow> m_flow;
  std::unique_ptr<DiffusionSolver> m_solver;  // behind a pointer, so that Eigen stays out of this header
  std::unique_ptr<DiffusionStep> m_step;
  SteadyState m_steadyState;
  std::vector<double> m_warpCoordinate;  // of each node, in the shape in which the effect was added [m]
  std::vector<double> m_saturation;
  std::vector<double> m_potential;
  std::vector<double> m_fluxes;  // of each edge [kg]
  std::vector<double> m_substepFluxes;
  double m_longestSubstep = 0;
  long long m_nodesVisited = 0;
  long long m_substeps = 0;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
