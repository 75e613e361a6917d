// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Effect.h"
#include "bullet_wetcloth/effects/Diffusion.h"
#include "bullet_wetcloth/numerics/SteadyState.h"

#include <memory>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class EdgeFlow;
class RestMesh;

/// Conductivity of a partly saturated cloth over that of a saturated one: s^exponent [-] (Brooks & Corey 1964; 3 for
/// thin films, Irmay 1954), of a saturation in [0, 1].
WETCLOTH_EXPORT double relativeConductivity(double saturation, double exponent);

/// Water that gravity drives along an edge [kg/s], towards its lower end if > 0: Darcy's law,
/// conductance speed s^exponent drop, with the saturation s of the upper end (upwind).
/// @param conductance  capacity per area times the edge's width over its length [kg/m^2]
/// @param speed  at saturation [m/s]
/// @param drop   from the first end down to the second, along gravity [m]
WETCLOTH_EXPORT double seepageFlow(double conductance, double speed, double exponent, double firstSaturation,
                                   double secondSaturation, double drop);

/// Gravity pulls water down inside the cloth, along its present shape.
///
/// c ds/dt = -div(c v s^exponent g_t), g_t the part of gravity's unit vector that lies in the cloth, v the speed at
/// saturation (Darcy 1856): each edge carries its share of the flow by its cotangent weight. It stops where the cloth
/// is saturated, so water pools at the lower hem; Dripping takes it from there. Explicit, in as many substeps as the
/// fastest wave asks for, 64 at most; beyond those water lags behind, but stays within bounds. Conserves water to
/// rounding.
class WETCLOTH_EXPORT Seepage : public Effect {
 public:
  /// What can be set, with units and ranges. Checked when the effect is made, and by setParameters().
  struct Parameters {
    /// v of saturated cloth hanging straight down under 9.81 m/s^2 [m/s], >= 0; it grows with gravity. The default is a
    /// guess.
    double speed = 5e-5;
    double exponent = 3;  ///< of s^exponent [-], in [1, 100]
  };

  /// Throws std::invalid_argument naming the field and the value.
  explicit Seepage(Parameters parameters);
  ~Seepage() override;

  /// As last set.
  const Parameters& parameters() const { return m_parameters; }
  /// Between steps, and all or nothing: throws as the constructor does, and then nothing has changed.
  void setParameters(Parameters parameters);

  const char* name() const override { return "Seepage"; }
  Stage stage() const override { return Stage::transport; }
  /// Throws std::invalid_argument when the body has no faces.
  void attach(WetCloth& cloth) override;
  void apply(WetCloth& cloth, const Step& step) override;
  void transferState(StateArchive& archive) override;

  /// Nodes visited so far: for tests that count work. A settled cloth adds none.
  long long nodesVisited() const { return m_nodesVisited; }
  /// Of all steps so far.
  long long substeps() const { return m_substeps; }

 private:
  void layEdges();
  void measureDepths(const WetCloth& cloth, const Step& step);
  double substepCount(double speed, double dt);
  void flow(double speed, double dt);

  Parameters m_parameters;
  const RestMesh* m_mesh = nullptr;  // the cloth's own
  std::unique_ptr<EdgeFlow> m_flow;
  SteadyState m_steadyState{SteadyState::DependsOn::waterAndShape};
  std::vector<double> m_depths;         // of nodes along gravity [m]
  std::vector<double> m_conductivity;   // of nodes, relative
  std::vector<double> m_outflow;        // of nodes, of saturated cloth at a speed of 1 m/s [kg/s]
  std::vector<double> m_fluxes;         // of edges [kg]
  std::vector<double> m_substepFluxes;  // [kg]
  long long m_nodesVisited = 0;
  long long m_substeps = 0;
};

/// Seepage that belongs to a diffusion, since both are parts of one law: Darcy's flow under the gradient of a capillary
/// head (Richards 1931; exponents of Brooks & Corey 1964 for pores that are alike). Where both balance in a strip that
/// stands in water, the saturation at the height z above it is exp(-z / height), if warp and weft are alike. So `speed`
/// is their diffusivities' geometric mean over that height, and `exponent` the diffusion's plus 1. Throws
/// std::invalid_argument when the height is not finite and > 0, or the diffusion is one that its constructor would
/// refuse.
/// @param height  [m], > 0; about that to which water rises in the end: 0.1 for the defaults
WETCLOTH_EXPORT Seepage::Parameters seepageInBalance(const Diffusion::Parameters& diffusion, double height);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
