// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <BulletSoftBody/btDefaultSoftBodySolver.h>
#include <BulletSoftBody/btSoftBody.h>

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class PackedNodes;
class StateArchive;

/// What keeps cloths from passing through themselves and each other: docs/guard.md.
struct ClothGuardParameters {
  /// Nearer than that layers do not approach, and slowly part [m], >= 0; at most half of the mean edge counts.
  double thickness = 0.002;
  bool self = true;       ///< a cloth and itself
  bool others = true;     ///< the cloths that the solver has taken, among each other
  int every = 10;         ///< for so many small steps ahead nodes are expected on their way, [1, 100]
  double friction = 0.3;  ///< between layers, coefficient, >= 0
  /// The cloths and rigid bodies, static, kinematic and dynamic ones, whose shapes are convex, triangle meshes, planes,
  /// or compounds of these: docs/guard.md says what is kept of which. A body that a cloth stops is slowed by it.
  bool bodies = false;
  /// Cloths that cross, since they were made or put so, are drawn out of each other, slowly and as far as that can be
  /// done; else they are left as they are.
  bool untangle = false;
};

/// Steps cloths faster and stiffer than Bullet does, behind Bullet's own seam: the last argument of its world.
///
///     wetcloth::ClothSolver solver;
///     btSoftRigidDynamicsWorld world(&dispatcher, &broadphase, &rigidSolver, &configuration, &solver);
///
/// For btSoftRigidDynamicsWorld and btSoftMultiBodyDynamicsWorld. In place of many passes over the links in one step it
/// takes small steps of one pass each (Macklin et al. 2019, "Small steps in physics simulation"), on arrays that a
/// processor works on several elements at once. Bodies that have what it does not know go on being stepped by Bullet's
/// own solver, as if this were not there: reasonNotTaken() says why.
///
/// It outlives the world. Bodies may be added, removed, cut and changed between steps.
class WETCLOTH_EXPORT ClothSolver final : public btDefaultSoftBodySolver {
 public:
  /// What keeps cloths from passing through themselves and each other.
  using Guard = ClothGuardParameters;
  /// What the guard has done since the start, or since resetGuardTotals().
  struct GuardTotals {
    long long looks = 0;        ///< small steps in which it looked for what may meet
    long long candidates = 0;   ///< pairs that it found there
    long long pairs = 0;        ///< of these, what it held apart until the next look
    long long stopped = 0;      ///< nodes that were slowed because nothing else kept them apart, each small step counts
    double longestStop = 0;     ///< the longest time for which a node was slowed in each small step [s]
    long long mostStopped = 0;  ///< the most nodes that were slowed in one small step
    btVector3 placeOfMost = btVector3(0, 0, 0);  ///< the mean of their places there [m]
    long long halts = 0;                         ///< small steps in which all cloths stood still
    long long forced = 0;                        ///< pairs that pins or bodies drove through each other, or might have
    long long meeting = 0;                       ///< the most pairs that met at one look already, and so may pass
    /// The most pairs of an edge and a face that crossed at once: counted when a cloth is new or was put elsewhere,
    /// when something was forced, and in each step in which they are untangled.
    long long crossing = 0;
    long long inside = 0;  ///< the most faces that stood in rigid bodies at once, and so may pass their surfaces
  };

  /// What can be set, with units and ranges.
  struct Parameters {
    /// In 1/60 s, [1, 1000]; a shorter step of Bullet's has fewer, a longer one more, up to 1000, so that they are
    /// about as long. Steps that are all alike have 4 in place of 1 or 2. Twice as many cost less than twice the time,
    /// and stretch a quarter.
    int smallSteps = 10;
    /// Of a link whose material has m_kLST = 1 [N/m], > 0; in proportion to it otherwise. Infinite: links do not
    /// stretch, and those with m_kLST < 1 are as soft as Bullet's own passes leave them, for the masses that the body
    /// had when it was taken.
    double stiffness = std::numeric_limits<double>::infinity();
    /// Of each node, to as many of its nearest pins (nodes without m_im), [0, 8]: it gets no further from them than
    /// along the links at rest. They hold a fine cloth at few small steps, whatever the links' stiffness is.
    int tethers = 0;
    /// How long tethers are, over the shortest way along the links at rest, [1, inf): 1.05 leaves a cloth that its
    /// weight stretches 5 %.
    double tetherScale = 1;
    /// Keeps cloths from passing through themselves and each other; none: it does not.
    std::optional<Guard> guard = std::nullopt;
  };

  /// What the application sees of a body after each small step.
  struct SmallStepView {
    const btSoftBody& body;  ///< that was taken
    int index;               ///< of the small step, from 0
    btScalar length;         ///< of the small step [s]
    const int* slots;        ///< where each node is in the arrays, one number a node
    const btScalar* x[3];    ///< places, relative to `origin` [m]
    btVector3 origin;        ///< [m]
    /// Of a node [m].
    btVector3 position(int node) const {
      return btVector3(x[0][slots[node]], x[1][slots[node]], x[2][slots[node]]) + origin;
    }
  };
  /// Called after each small step. It changes nothing. One that throws is not called again, and the log says why.
  using SmallStepCallback = std::function<void(const SmallStepView&)>;
  /// The same for what lives as long as it likes: parts of the library, which leave the callback to the application.
  class SmallStepObserver {
   public:
    virtual ~SmallStepObserver() = default;
    /// After the application's callback. It changes nothing, and does not throw.
    virtual void afterSmallStep(const SmallStepView& view) = 0;
  };

  /// Throws std::invalid_argument naming the field and the value.
  explicit ClothSolver(const Parameters& parameters);
  /// With the defaults.
  ClothSolver();
  ~ClothSolver() override;
  ClothSolver(const ClothSolver&) = delete;
  ClothSolver& operator=(const ClothSolver&) = delete;

  /// As last set.
  const Parameters& parameters() const;
  /// Between steps. Throws as the constructor does; then nothing has changed.
  void setParameters(const Parameters& parameters);

  /// Why this body is stepped by Bullet's own solver, or not at all; empty: it is taken, from the next step on. What it
  /// says of other bodies is what they were in the last step.
  std::string reasonNotTaken(const btSoftBody& body) const;
  /// How many Parameters::smallSteps a body needs so that its links stretch as their stiffness says: h^2 is then at
  /// most the inverse of stiffness and half the sum of both ends' inverse masses, for every link. As the body was in
  /// the last step; 1 when it was not taken. A link that does not stretch needs none.
  int smallStepsFor(const btSoftBody& body) const;

  /// What the guard has done.
  GuardTotals guardTotals() const;
  /// Counts from here on.
  void resetGuardTotals();
  /// The nodes of a body that the guard slowed or stopped in the last step, ascending; none of one that is not taken.
  std::vector<int> stoppedNodes(const btSoftBody& body) const;

  /// Scales the stiffness of each link of a body that is taken, in the order of btSoftBody::m_links, without touching
  /// its material: factors > 0, or none at all; a link of a factor that is not > 0 does not pull. `revision` tells this
  /// call's factors from another's: with that of the last call nothing is done. WetCloth calls it in each step for what
  /// WetStiffness has set.
  void setLinkStiffness(const btSoftBody& body, const std::vector<btScalar>& factors, unsigned long long revision);

  /// What the guard does between layers of a body that is taken, by node: it multiplies Guard::friction by these, >= 0;
  /// of two layers the larger factor counts. Empty, or not one a node: by 1, and so where one is not finite and >= 0.
  /// WetCloth calls it in each step for WetFriction.
  void setLayerFriction(const btSoftBody& body, const std::vector<btScalar>& factors);
  /// What keeps each node on a layer that it touches, away from it and along it [N], >= 0; empty, or not one a node:
  /// nothing, and so where one is not finite and >= 0. WetCloth
  /// calls it in each step for Cling.
  void setLayerCling(const btSoftBody& body, const std::vector<btScalar>& pull, const std::vector<btScalar>& shear);

  /// Sees the nodes' places after each small step; an empty one sees nothing.
  void setSmallStepCallback(SmallStepCallback callback);
  /// Between steps. It is called for as long as it lives; adding it again does nothing.
  void addObserver(const std::shared_ptr<SmallStepObserver>& observer);
  /// Takes messages, of a cloth that is not finite or whose links need more small steps. The default writes to
  /// std::clog; an empty function silences them.
  void setLog(std::function<void(const std::string&)> log);

  /// The nodes' arrays of a body that is taken, for WetCloth; null of one that is not, or was cut since the last step.
  PackedNodes* packedNodes(const btSoftBody& body);
  /// Parameters::smallSteps are those in 1 / kSmallStepsPer [s].
  static constexpr double kSmallStepsPer = 60;
  /// How many small steps a step has where all are dt [s] long.
  static int smallStepsOf(const Parameters& parameters, double dt);
  /// How many a body that is taken has in a step of dt [s], which its own timescale changes; 0 of one that is not.
  int smallStepsIn(const btSoftBody& body, double dt) const;
  /// The ClothSolver that steps the soft bodies of this one's world, or null.
  static ClothSolver* of(const btSoftBody& body);
  /// Names what goes on from step to step for these bodies, all of the world: see StateArchive. WetClothWorld::save()
  /// and restore() call it.
  void transferState(StateArchive& archive, const btAlignedObjectArray<btSoftBody*>& bodies);

  // What Bullet's world calls. An application does not.

  /// At the start of a step: takes the bodies that it can, and lets go of those that have left the world.
  void optimize(btAlignedObjectArray<btSoftBody*>& bodies, bool forceUpdate = false) override;
  /// Reads the nodes, and predicts where they will be.
  void predictMotion(btScalar dt) override;
  /// Finds the contacts with a rigid body or a link of a multibody.
  void processCollision(btSoftBody* body, const btCollisionObjectWrapper* object) override;
  /// Of two soft bodies: the guard's, if it has them; else Bullet's.
  void processCollision(btSoftBody* body, btSoftBody* other) override;
  /// The small steps.
  void solveConstraints(btScalar dt) override;
  /// Writes back what Bullet and applications read.
  void updateSoftBodies() override;

 private:
  class Impl;
  std::unique_ptr<Impl> m_impl;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
