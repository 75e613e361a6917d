// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Effect.h"
#include "bullet_wetcloth/numerics/DropCatcher.h"
#include "bullet_wetcloth/numerics/SteadyState.h"

#include <variant>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Flux in the drops of a hose [kg/m^2/s], at a distance r from its mouth: flux (reach / r)^2, so that the same flow
/// goes through every cross-section. Nearer than reach / 100, the size of the mouth, it grows no more.
/// @param distance  r [m]; @param flux  at r = reach [kg/m^2/s]; @param reach  [m]
WETCLOTH_EXPORT double coneFlux(double distance, double flux, double reach);

/// Water that such a hose gives [kg/s]: flux x the cap of a sphere of radius `reach`, 2 pi (1 - cos h) reach^2 flux.
/// @param halfAngle  h [rad]
WETCLOTH_EXPORT double coneFlow(double halfAngle, double flux, double reach);

/// Water thrown at the cloth within a sphere, or from a hose. Each triangle whose centroid is inside catches flux x
/// projected area (caughtFlux()), on either side. Nodes take what they can hold; the rest runs off (Ledger::runOff).
/// All of it brings the drops' momentum. Triangles do not shelter each other, but together they never catch more than
/// the water carries: what would be more is shared out in proportion.
///
/// Idles while the flux is 0, and once nothing has been struck for 64 steps: until the region or the cloth's shape
/// changes (SteadyState).
class WETCLOTH_EXPORT Splash : public Effect {
 public:
  /// A stream of the same flux and velocity everywhere; it carries pi radius^2 flux.
  struct Sphere {
    btVector3 centre = btVector3(0, 0, 0);  ///< [m]
    double radius = 0.1;                    ///< [m], > 0
  };
  /// A hose: drops fly straight from its mouth; see coneFlux() and coneFlow().
  struct Cone {
    btVector3 apex = btVector3(0, 0, 0);  ///< its mouth [m]
    double halfAngle = 0.1;               ///< between its axis and its side [rad], (0, pi/2)
    double reach = 1;                     ///< how far the drops fly from the mouth [m], > 0
  };
  /// Where the drops are.
  using Region = std::variant<Sphere, Cone>;

  /// What can be set, with units and ranges. Checked when the effect is made, and by setParameters().
  struct Parameters {
    Region region = Sphere();  ///< where the drops are
    /// Of the drops [m/s], of any length > 0. In a cone its direction is the axis, its length each drop's speed.
    btVector3 velocity = btVector3(0, -5, 0);
    /// [kg/m^2/s] through an area across the stream, >= 0; in a cone that at its far end, `reach`.
    double flux = 1;
  };

  /// Throws std::invalid_argument naming the field and the value.
  explicit Splash(Parameters parameters);

  /// As last set.
  const Parameters& parameters() const { return m_parameters; }
  /// Between steps, and all or nothing: throws as the constructor does, and then nothing has changed.
  void setParameters(Parameters parameters);

  const char* name() const override { return "Splash"; }
  Stage stage() const override { return Stage::sources; }
  /// Throws std::invalid_argument when the body has no faces.
  void attach(WetCloth& cloth) override;
  void apply(WetCloth& cloth, const Step& step) override;
  /// While drops strike: a sleeping body would be carried off by their momentum.
  bool wakes(const WetCloth& cloth, const Step& step) const override;
  void transferState(StateArchive& archive) override;

  /// Water that struck the cloth in the last step [kg].
  double caught() const { return m_catcher.caught(); }
  /// Nodes visited so far: for tests that count work. An idle effect adds none.
  long long nodesVisited() const { return m_nodesVisited; }

 private:
  void catchDrops(const Sphere& sphere, double dt);
  void catchDrops(const Cone& cone, double dt);
  double flow() const;

  Parameters m_parameters;
  DropCatcher m_catcher;
  SteadyState m_steadyState{SteadyState::DependsOn::waterAndShape};
  long long m_nodesVisited = 0;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
