// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Effect.h"
#include "bullet_wetcloth/effects/WaterSurface.h"
#include "bullet_wetcloth/numerics/NodeUptake.h"
#include "bullet_wetcloth/numerics/NothingLeft.h"
#include "bullet_wetcloth/numerics/SteadyState.h"

#include <optional>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Share of its free capacity that a node at this depth fills in dt, exact for any dt: 1 - exp(-dt / theta) below the
/// surface, 0 at it and above (Basori et al. 2017, Eq. 2, with an exposure of 1 below).
/// @param depth  below the surface [m], negative above it
/// @param dt     [s]; @param timeConstant  theta [s]
WETCLOTH_EXPORT double immersionShare(double depth, double dt, double timeConstant);

/// A cloth in a body of water: nodes below its surface soak by their fabric's own law, where they are in each step.
///
/// Idles while every node is full, and once nothing has been left to soak for 64 steps: until the surface, the
/// cloth's water or its shape changes. A shape that sinks towards the surface is noticed before it is there, and any
/// other change as SteadyState says.
class WETCLOTH_EXPORT Immersion : public Effect {
 public:
  /// What can be set, with units and ranges. Checked when the effect is made, and by setParameters().
  struct Parameters {
    /// The water; none: what the application has given to Bullet (btSoftBodyWorldInfo::water_normal, water_offset),
    /// as it is in each step. The water arrives with the surface's velocity; its density does not matter here.
    std::optional<WaterSurface> surface = {};
  };

  /// Throws std::invalid_argument naming the field and the value.
  explicit Immersion(Parameters parameters);

  /// As last set.
  const Parameters& parameters() const { return m_parameters; }
  /// Between steps, and all or nothing: throws as the constructor does, and then nothing has changed. A surface of none
  /// is Bullet's own again, or no water.
  void setParameters(Parameters parameters);

  const char* name() const override { return "Immersion"; }
  Stage stage() const override { return Stage::sources; }
  /// Throws std::invalid_argument when the effect is added and there is no water, neither its own nor Bullet's.
  void attach(WetCloth& cloth) override;
  void apply(WetCloth& cloth, const Step& step) override;
  void transferState(StateArchive& archive) override;

  /// Nodes visited so far: for tests that count work. An idle effect adds none.
  long long nodesVisited() const { return m_nodesVisited; }

 private:
  void noticeSurface(const std::optional<WaterSurface>& surface);
  bool isIdle(const WetCloth& cloth, const Step& step);
  void soak(WetCloth& cloth, const Step& step);
  double reach(const btSoftBody& body) const;

  Parameters m_parameters;
  NodeUptake m_uptake;
  SteadyState m_steadyState{SteadyState::DependsOn::waterAndShape};
  std::vector<double> m_shares;           // of each fabric: what a node below fills of its room in the step
  std::optional<WaterSurface> m_surface;  // in the last step
  double m_reachLimit = 0;                // depth of the body's bounds at which an idle cloth above is looked at [m]
  NothingLeft m_nothingLeft;              // to fill
  long long m_nodesVisited = 0;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
