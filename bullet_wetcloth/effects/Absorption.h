// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Effect.h"
#include "bullet_wetcloth/effects/Exposure.h"
#include "bullet_wetcloth/numerics/NodeUptake.h"
#include "bullet_wetcloth/numerics/NothingLeft.h"

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Share of its free capacity that a node fills in dt, exact for any dt: 1 - exp(-rate), from dw/dt = e (C - w) /
/// theta (Basori et al. 2017, Eq. 2, with an exposure e).
/// @param rate  e dt / theta [-], >= 0
WETCLOTH_EXPORT double exponentialShare(double rate);

/// The same by forward Euler, the paper's own integrator (Eq. 1): rate, at most 1.
WETCLOTH_EXPORT double eulerShare(double rate);

/// Soaks a cloth: each node takes up water according to how far it is exposed to it.
class WETCLOTH_EXPORT Absorption : public Effect {
 public:
  /// How the water of a node grows in time.
  enum class Law {
    exponential,   ///< Eq. 2, exact for any step
    forwardEuler,  ///< Eq. 1, the paper's integrator, first order in dt
    ramp           ///< Table II: to capacity in `rampDuration` at constant rate
  };

  /// What can be set, with units and ranges. Checked when the effect is made, and by setParameters().
  struct Parameters {
    /// How far a node is in contact with water, [0, 1]: a constant, one value per node, or a function of the
    /// node's position and normal and of time, asked for the middle of the step.
    Exposure exposure = 1.0;
    Law law = Law::exponential;  ///< of a node's water in time
    /// Velocity of the water that arrives [m/s]; v' = (m v + dm u) / (m + dm).
    btVector3 waterVelocity = btVector3(0, 0, 0);
    /// False: the paper's own way, mass is added at unchanged velocity (it makes momentum from nothing).
    bool conservesMomentum = true;
    /// Time from dry to saturated under Law::ramp [s], > 0.
    double rampDuration = 10;

    /// The paper letter by letter: the ramp of Table II, velocities unchanged.
    static Parameters paper();
  };

  /// Throws std::invalid_argument naming the field and the value.
  explicit Absorption(Parameters parameters);

  /// As last set.
  const Parameters& parameters() const { return m_parameters; }
  /// Between steps, and all or nothing: throws as the constructor does, or when an exposure has not one value per node,
  /// and then nothing has changed.
  void setParameters(Parameters parameters);

  const char* name() const override { return "Absorption"; }
  Stage stage() const override { return Stage::sources; }
  /// Throws std::invalid_argument when the effect is added and an exposure has not one value per node.
  void attach(WetCloth& cloth) override;
  void apply(WetCloth& cloth, const Step& step) override;
  void transferState(StateArchive& archive) override;

  /// Nodes visited so far: for tests that count work. A settled cloth adds none.
  long long nodesVisited() const { return m_nodesVisited; }

 private:
  double share(double exposure, double timeConstant, const Step& step) const;
  bool takeUp(WetCloth& cloth, std::size_t node, double share);

  Parameters m_parameters;
  std::vector<double> m_uniformShares;  // of each fabric, where all nodes are exposed alike
  NodeUptake m_uptake;
  NothingLeft m_nothingLeft;
  bool m_hasNormals = false;
  long long m_nodesVisited = 0;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
