// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Effect.h"
#include "bullet_wetcloth/numerics/DropCatcher.h"
#include "bullet_wetcloth/numerics/Shelter.h"

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Rain on the cloth's triangles, in their present shape: each catches flux x projected area (caughtFlux()), on
/// either side. Nodes take what they can hold; the rest runs off (Ledger::runOff). All of it brings the drops'
/// momentum, so rain also pushes a cloth that is full. The flux is that on a cloth at rest: a cloth that flies
/// against the rain catches no more of it.
///
/// Idles while the flux is 0.
class WETCLOTH_EXPORT Rain : public Effect {
 public:
  /// What can be set, with units and ranges. Checked when the effect is made, and by setParameters().
  struct Parameters {
    btVector3 direction = btVector3(0, -1, 0);  ///< in which the drops fall, of any length > 0
    /// [kg/m^2/s] through a plane across the direction, >= 0. 1 mm/h is 1/3600 kg/m^2/s; the default is 10 mm/h, which
    /// meteorologists call heavy.
    double flux = 2.8e-3;
    /// Of the drops [m/s], >= 0. Drops of 2 mm fall at 6.5 m/s in still air (Gunn & Kinzer 1949).
    double speed = 6.5;
    /// A triangle that is behind another one along the rain, seen at its centroid, catches none (Shelter).
    bool selfShelter = false;
  };

  /// Throws std::invalid_argument naming the field and the value.
  explicit Rain(Parameters parameters);

  /// As last set.
  const Parameters& parameters() const { return m_parameters; }
  /// Between steps, and all or nothing: throws as the constructor does, and then nothing has changed.
  void setParameters(Parameters parameters);

  const char* name() const override { return "Rain"; }
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
  void catchDrops(const btVector3& direction, double dt);

  Parameters m_parameters;
  DropCatcher m_catcher;
  Shelter m_shelter;  // empty unless asked for
  long long m_nodesVisited = 0;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
