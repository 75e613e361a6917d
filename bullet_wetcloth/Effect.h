// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <LinearMath/btVector3.h>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class StateArchive;
class WetCloth;

/// The fixed order of a step, whatever order effects were added in. Between `material` and `forces` the step
/// commits: masses, momentum and link constants are written once, and only if water moved.
///
/// `observe` to `elasticity` run in the pre-tick, before Bullet predicts. While Bullet lets the body sleep, `observe`
/// to `material` run all the same, since water moves in a cloth at rest and its nodes may be moved by hand.
enum class Stage {
  observe,     ///< looks at how the last substep ended, before any effect of any cloth changes anything
  sources,     ///< water arrives: absorption, rain, immersion, contact
  transport,   ///< water spreads inside the cloth
  losses,      ///< water leaves: dripping, drying
  material,    ///< what wetness changes in the fabric
  forces,      ///< velocity changes: wind, drag, cling
  elasticity,  ///< springs that must see the velocities of all other forces
  contact      ///< after Bullet's collision detection and before its solve: changes the contacts that were found
};

/// What an effect is told about the substep.
struct Step {
  double dt;          ///< the substep as the body sees it (its timescale included) [s], > 0
  double time;        ///< simulated time at the start of the substep [s]
  btVector3 gravity;  ///< acceleration that Bullet will add to the body in this substep [m/s^2]
  /// Of the velocity that gravity adds in this substep, the share with which the body moves in it: 1 in Bullet's
  /// solvers, (n + 1) / 2 n in n small steps of ClothSolver.
  double fallShare = 1;

  /// Simulated time in the middle of the step [s]. What changes in time is looked at then by a law that is exact while
  /// it stays the same: the step is of second order so (the midpoint rule), and of first order at either end.
  double middle() const { return time + dt / 2; }
};

/// One question that a scene asks of a cloth, answered once per substep.
///
/// The contract of a derived class:
/// - its constructor checks its parameters and throws std::invalid_argument naming the field and the value;
/// - attach() is called once, when the effect is added, and again whenever the body's nodes, links or faces
///   changed in number, or somebody changed its links' lengths at rest; it builds what apply() needs and throws
///   std::invalid_argument when the body lacks it;
/// - apply() never throws, never writes a value that is not finite, and never allocates after its first call, but to
///   factor a matrix anew when the step's length, the masses or the stiffness have changed;
/// - it changes water only through WetCloth::water(), and velocities only through WetCloth::push(); water that leaves a
///   node takes the velocity that the node has after WetCloth::joinArrivals(); at the stage `contact` it changes
///   neither: the position-based worlds would lose the velocities, and the commit has been; at the stage `observe` it
///   changes nothing at all.
class WETCLOTH_EXPORT Effect {
 public:
  virtual ~Effect() = default;
  /// For messages and tables: the class's name, without its namespace. It must outlive the effect.
  virtual const char* name() const = 0;
  /// When in the step it runs. Always the same.
  virtual Stage stage() const = 0;
  /// The effect has been added, or the body's nodes, links or faces have changed in number: builds what apply() needs.
  /// Throws std::invalid_argument when the body lacks it.
  virtual void attach(WetCloth& cloth) { static_cast<void>(cloth); }
  /// The effect is about to be removed: gives back what it changed in the body.
  virtual void detach(WetCloth& cloth) { static_cast<void>(cloth); }
  /// Whether apply() reads and changes nodes through WetCloth::packedNodes() alone, which effects that follow each
  /// other share. The others find the nodes of the body up to date.
  virtual bool usesPackedNodes() const { return false; }
  /// Does its part of one substep. Never throws.
  virtual void apply(WetCloth& cloth, const Step& step) = 0;
  /// Asked instead of apply() at the stages from `forces` on while Bullet lets the body sleep (it does so in
  /// the deformable world only): true wakes the body.
  virtual bool wakes(const WetCloth& cloth, const Step& step) const {
    static_cast<void>(cloth);
    static_cast<void>(step);
    return false;
  }
  /// Names what apply() carries from one step to the next, for WetClothWorld::save() and restore(): see StateArchive.
  /// Parameters are the application's, and what attach() builds is there already. An effect without this goes on, after
  /// a restore, as if it had just been added.
  virtual void transferState(StateArchive& archive) { static_cast<void>(archive); }

  /// What an effect remembers is of one cloth.
  Effect(const Effect&) = delete;
  Effect& operator=(const Effect&) = delete;

 protected:
  Effect() = default;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
