// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/WorldPart.h"
#include "bullet_wetcloth/drops/Pour.h"
#include "bullet_wetcloth/effects/WaterSurface.h"
#include "bullet_wetcloth/effects/WindField.h"
#include "bullet_wetcloth/numerics/DropFlight.h"

#include <LinearMath/btVector3.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>

class btCollisionObject;

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// A drop in flight: a sphere of water.
struct Drop {
  btVector3 position;  ///< of its middle [m]
  btVector3 velocity;  ///< [m/s]
  double mass;         ///< [kg]
  double diameter;     ///< [m]
};

/// A drop that has landed, or come to its end.
struct Landing {
  double time;                    ///< at the end of the substep in which it landed [s]
  btVector3 position;             ///< where [m]
  btVector3 velocity;             ///< with which it came [m/s]
  double mass;                    ///< of the drop [kg]
  double kept;                    ///< of it, what the cloth took up, or what stays on the body as a film [kg]
  WetCloth* cloth;                ///< on which it landed; null: on none
  const btCollisionObject* body;  ///< on which it landed; null: on none. Both null: in water, or out of the world
};

/// Where all water of a world came from and is now [kg], all cloths together, since Drops were added. At every step, to
/// rounding, initial + absorbed + brought == held + inFlight + films + evaporated + left.
struct WorldLedger {
  double initial = 0;     ///< held by cloths when they were first followed, plus what was set by hand since
  double absorbed = 0;    ///< brought by the cloths' own sources, but for drops, films and other cloths
  double brought = 0;     ///< brought by pours, and what struck cloths from rain and hoses and ran off
  double held = 0;        ///< in the cloths now
  double inFlight = 0;    ///< in drops, those among them that are growing at a node and not large enough yet
  double films = 0;       ///< on rigid bodies, where drops landed
  double evaporated = 0;  ///< from the cloths
  double left = 0;  ///< ran off bodies, fell out of the world or into water, or went with a cloth that was removed

  /// Zero to rounding.
  double imbalance() const { return initial + absorbed + brought - held - inFlight - films - evaporated - left; }
};

/// Drops of a world that fly and land: what drips from its cloths (Dripping), what runs off them (Rain, Splash, and
/// drops themselves) and what pours from spouts and glasses.
///
/// A drop flies by gravity, drag by its size (dropDecay()) and wind, and lands on the first cloth or rigid body that it
/// meets. No drop passes through a cloth: its straight way in a substep is checked against the faces' ways in the same
/// substep, and no contact is missed (collision::ContinuousCheck). The cloth's nodes take up what they have room for,
/// at the place that the drop hits, with its momentum; the rest hops on along the cloth, on the side that it came from,
/// as a smaller drop. What lands on a rigid body pushes that and stays there as a film, from which ContactWetting gives
/// to cloth that touches; what is more than `filmDensity` hops on, too. Drops do not meet each other, and films do not
/// flow.
///
/// What leaves a cloth grows at its node until it is `dropMass`, and falls then, with the node's velocity. When there
/// are `mostDrops`, a new drop joins the nearest one.
///
/// Drops fly one substep behind: in a substep they go the way of the one before, in which it is known how cloths and
/// bodies moved. There is one Drops in a world; it must not outlive its parameters' functions. It does nothing while no
/// drop flies, none falls and nothing pours.
class WETCLOTH_EXPORT Drops : public WorldPart {
 public:
  /// What can be set, with units and ranges. Checked when it is made, and by setParameters().
  struct Parameters {
    /// Of the drops that fall from cloth [kg], > 0; as Dripping::Parameters::dropMass.
    double dropMass = 5e-5;
    DropAir air = {};           ///< through which drops fly, and the density of water
    WindField wind = {};        ///< velocity of the air [m/s]
    int mostDrops = 10000;      ///< in flight, >= 1
    double longestFlight = 10;  ///< after which a drop has left the world [s], > 0
    /// Water that stays on a rigid body where drops land [kg/m^2], >= 0: 0.5 mm deep; a guess. 0: none stays.
    double filmDensity = 0.5;
    /// Size of the places on a body that have a film each [m], > 0: no smaller than the meshes of cloth that touches.
    double filmCell = 0.05;
    /// Where drops end; none: they do not end in water.
    std::optional<WaterSurface> surface = {};
    /// Takes each drop that lands, inside the step. It must not change soft bodies, effects, water or drops. If it
    /// throws, it is not asked any more, and a message says so.
    std::function<void(const Landing&)> onLanding = {};
  };

  /// In this world from now on. Throws std::invalid_argument naming the field and the value, or when the world has
  /// drops already.
  Drops(WetClothWorld& world, Parameters parameters);
  /// The same with the defaults.
  explicit Drops(WetClothWorld& world);
  ~Drops() override;

  /// As last set.
  const Parameters& parameters() const;
  /// Between steps, and all or nothing: throws as the constructor does, and when filmCell or filmDensity are other ones
  /// than before while there are films; then nothing has changed.
  void setParameters(Parameters parameters);

  /// One more spout; returns its number, the first being 0. Throws std::invalid_argument naming the field and the
  /// value.
  std::size_t add(Pour pour);
  /// One more glass; returns its number, the first being 0. Throws std::invalid_argument naming the field and the
  /// value.
  std::size_t add(Glass glass);
  /// How many spouts there are.
  std::size_t pours() const;
  /// As last set. Throws std::out_of_range.
  const Pour& pour(std::size_t number) const;
  /// Between steps. Throws std::out_of_range, and std::invalid_argument naming the field and the value.
  void setPour(std::size_t number, Pour pour);
  /// How many glasses there are.
  std::size_t glasses() const;
  /// Water left in a glass [kg]. Throws std::out_of_range.
  double waterIn(std::size_t glass) const;

  /// Drops in flight.
  std::size_t size() const;
  /// One of them; the order changes from step to step. `i` must be in [0, size()).
  Drop operator[](std::size_t i) const;
  /// Writes x, y, z and radius [m] of all drops, where they are at `time` [s] if nothing stops them on the way: to draw
  /// them. @param spheres  has room for 4 size() numbers
  void writeSpheres(float* spheres, double time) const;

  /// Where all water is.
  WorldLedger ledger() const;
  /// Film that landed on a body [kg].
  double filmOn(const btCollisionObject& body) const;

  /// Drops that have begun to fly so far,
  long long born() const;
  /// that have landed on cloth,
  long long landedOnCloth() const;
  /// that have landed on bodies or in water, or have left,
  long long ended() const;
  /// and that have joined others.
  long long merged() const;
  /// Drops and faces of cloth that were looked at closely: for tests that count work.
  long long candidates() const;

 private:
  struct State;
  class Flight;

  void step(double dt, double time) override;
  void follow(WetCloth& cloth) override;
  void forget(const WetCloth& cloth) override;
  BodyFilms* films() override;
  void transferState(StateArchive& archive) override;

  std::unique_ptr<State> m_state;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
