// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/BodyWatch.h"
#include "bullet_wetcloth/Effect.h"
#include "bullet_wetcloth/EffectList.h"
#include "bullet_wetcloth/EffectType.h"
#include "bullet_wetcloth/Fabric.h"
#include "bullet_wetcloth/Range.h"
#include "bullet_wetcloth/bullet/PackedNodes.h"
#include "bullet_wetcloth/mesh/RestLengths.h"
#include "bullet_wetcloth/mesh/RestMesh.h"
#include "bullet_wetcloth/shading/Colour.h"
#include "bullet_wetcloth/water/LinkConstants.h"
#include "bullet_wetcloth/water/NodeMasses.h"
#include "bullet_wetcloth/water/Water.h"
#include "bullet_wetcloth/water/WaterPace.h"

#include <BulletSoftBody/btSoftBody.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class WetClothWorld;

/// One btSoftBody of an application, its water, its fabrics and its effects. Made by WetClothWorld::add().
///
/// Units are SI. Nodes are numbered as in btSoftBody::m_nodes.
class WETCLOTH_EXPORT WetCloth {
 public:
  WetCloth(const WetCloth&) = delete;
  WetCloth& operator=(const WetCloth&) = delete;
  ~WetCloth();

  /// The application's body, as it gave it to WetClothWorld::add().
  btSoftBody& body() { return m_body; }
  /// The same, to look at.
  const btSoftBody& body() const { return m_body; }
  /// What it is made of, as given to WetClothWorld::add(): the first fabric where there are several.
  const Fabric& fabric() const { return m_fabrics.front(); }
  /// All that it is made of, at least one.
  const std::vector<Fabric>& fabrics() const { return m_fabrics; }
  /// What a node is made of. One that a cut or a refinement made is of the fabric that it was cut from. Throws
  /// std::out_of_range.
  const Fabric& fabric(int node) const;

  /// How often its water moves, and when its weight follows.
  const WaterPace& pace() const { return m_pace; }
  /// Between steps. Throws std::invalid_argument naming the field and the value; then nothing has changed.
  void setPace(const WaterPace& pace);

  // --- effects ----------------------------------------------------------------------------------------------

  /// Adds an effect and returns it: `towel.add<Absorption>()`, or with parameters that are set by name:
  ///
  ///     Wind::Parameters air;
  ///     air.velocity = btVector3(4, 0, 1);  // [m/s]
  ///     towel.add<Wind>(air);
  ///
  /// Throws std::invalid_argument when a parameter is out of range or the body lacks what the effect needs, and in a
  /// step; the cloth is then as it was.
  template <class E>
  E& add(typename E::Parameters parameters = {}) {
    return add(std::make_unique<E>(std::move(parameters)));
  }
  /// Adds an effect of your own. Throws std::invalid_argument on null, and what its attach() throws; the cloth is then
  /// as it was.
  template <class E, class Deleter>
  E& add(std::unique_ptr<E, Deleter> effect) {
    E* const added = effect.get();
    add(std::move(effect), &EffectType<E>::tag);
    return *added;
  }
  /// The same for one whose class is not known here: find() and forEach() pass it over.
  Effect& add(std::unique_ptr<Effect> effect) { return add(std::move(effect), nullptr); }
  /// Removes an effect of this cloth and deletes it. Throws std::invalid_argument when it is not one of them and in a
  /// step, and what its detach() throws.
  void remove(Effect& effect);

  /// In the order in which the step runs them: `for (Effect& effect : towel.effects())`. Ends with the next add() or
  /// remove().
  Range<Effect, EffectList::Entry> effects() { return Range<Effect, EffectList::Entry>(m_effects.entries()); }
  /// The same, to look at.
  Range<const Effect, EffectList::Entry> effects() const {
    return Range<const Effect, EffectList::Entry>(m_effects.entries());
  }
  /// The first effect that was added as an E, or null: `if (Wind* wind = towel.find<Wind>())`. What was added as
  /// something else is not found, be it derived from E. Needs no RTTI.
  template <class E>
  E* find() {
    return static_cast<E*>(m_effects.find(&EffectType<E>::tag));
  }
  /// The same, to look at.
  template <class E>
  const E* find() const {
    return static_cast<const E*>(m_effects.find(&EffectType<E>::tag));
  }
  /// Whether an effect of this Effect::name() is there, other than `but`; whatever class it was added as.
  bool has(const char* name, const Effect* but = nullptr) const { return m_effects.has(name, but); }
  /// Calls action(E&) for each effect that was added as an E, in the order of effects().
  template <class E, class Action>
  void forEach(Action action) {
    for (const EffectList::Entry& entry : m_effects.entries()) {
      if (entry.type == &EffectType<E>::tag) action(static_cast<E&>(*entry));
    }
  }
  /// The same, to look at.
  template <class E, class Action>
  void forEach(Action action) const {
    for (const EffectList::Entry& entry : m_effects.entries()) {
      if (entry.type == &EffectType<E>::tag) action(static_cast<const E&>(*entry));
    }
  }

  // --- water ------------------------------------------------------------------------------------------------

  // To read right after the body was cut or refined is to adapt to it, as the next step would: effects attach again.

  /// Nodes of the body.
  int nodeCount() const;
  /// held / capacity of a node: 0 dry, 1 saturated. Throws std::out_of_range.
  double saturation(int node) const;
  /// Water held by a node [kg]. Throws std::out_of_range.
  double held(int node) const;
  /// Dry mass of a node [kg], of pinned ones too. Throws std::out_of_range.
  double dryMass(int node) const;
  /// Water that a node holds at saturation [kg]. Throws std::out_of_range.
  double capacity(int node) const;
  /// Dry mass and water of all nodes, pinned ones included [kg].
  double totalMass() const;
  /// Water of the whole cloth over what it can hold.
  double meanSaturation() const;
  /// Where the water of the cloth came from and went to [kg]: closes to rounding at every step.
  Ledger ledger() const { return m_water.ledger(); }

  /// Sets every node to this saturation, [0, 1], and commits the masses. Velocities stay.
  /// Throws std::invalid_argument naming the value when it is not in [0, 1].
  void setSaturation(double saturation);
  /// Sets the water of each node [kg], one finite value >= 0 per node, and commits the masses. Velocities stay.
  /// Throws std::invalid_argument naming the node and the value, or the number of values when it is not that of the
  /// nodes; then nothing changes.
  void setHeld(const std::vector<double>& held);

  // --- looks ------------------------------------------------------------------------------------------------

  /// Diffuse colour of a node, linear RGB (Lekner & Dorf 1988). Computed when asked. Throws std::out_of_range.
  Colour colour(int node) const;
  /// Roughness of a node for a renderer, [0, 1]. Throws std::out_of_range.
  double roughness(int node) const;

  // --- for effects ------------------------------------------------------------------------------------------

  /// The world that it was added to.
  WetClothWorld& world() { return m_world; }
  /// The same, to look at.
  const WetClothWorld& world() const { return m_world; }
  /// The water of each node. Change it inside a step only: setHeld() and setSaturation() are for the time between.
  Water& water() { return m_water; }
  /// The same, to look at.
  const Water& water() const { return m_water; }
  /// What a node is made of, as fabric(int) but unchecked: within a step.
  const Fabric& fabricOf(std::size_t node) const { return m_fabrics[m_water.fabric(node)]; }
  /// The one writer of the nodes' masses.
  NodeMasses& masses() { return m_masses; }
  /// The same, to look at.
  const NodeMasses& masses() const { return m_masses; }
  /// The one writer of what Bullet derives for each link.
  LinkConstants& linkConstants() { return m_linkConstants; }
  /// The same, to look at.
  const LinkConstants& linkConstants() const { return m_linkConstants; }
  /// The lengths of the links at rest, and who changes them.
  RestLengths& restLengths() { return m_restLengths; }
  /// The same, to look at.
  const RestLengths& restLengths() const { return m_restLengths; }
  /// The nodes' places, velocities and inverse masses in arrays. An effect that asks for them says so in
  /// Effect::usesPackedNodes(), and calls fit() in attach().
  PackedNodes& packedNodes();
  /// The cloth's triangles at rest. Built when first asked for, and again after the body's nodes, links or faces
  /// changed in number, or the lengths of its links at rest, and with the first effect: ask in attach(), which is
  /// called then.
  const RestMesh& restMesh();

  /// Adds to a free node's velocity, in the way that each of Bullet's worlds takes notice of.
  /// Pinned nodes and values that are not finite are ignored.
  void push(btSoftBody::Node& node, const btVector3& deltaVelocity) {
    const btScalar size = deltaVelocity.x() + deltaVelocity.y() + deltaVelocity.z();
    if (node.m_im == 0 || !(size - size == 0)) return;
    if (m_nodesAreBehind) releaseNodes();
    node.m_v += deltaVelocity;
    // The deformable world's implicit solve starts from the velocity at the end of the last step.
    if (m_deformable) node.m_vn += deltaVelocity;
  }

  /// Whether the guard of a ClothSolver keeps it from layers that it touches, of others or its own. Wetness then counts
  /// there by what an effect says in each step, in the stage forces or contact:
  bool isGuarded();
  /// Of each node: a factor of the guard's friction, >= 0; of two layers the larger one counts. Empty, or not one a
  /// node: 1, and so where one is not finite and >= 0.
  void setLayerFriction(const std::vector<btScalar>& factors);
  /// Of each node: what keeps it on the layer on each of its two sides, away from it and along it [N], >= 0. Empty,
  /// or not one a node: 0, and so where one is not finite and >= 0.
  void setLayerCling(const std::vector<btScalar>& pull, const std::vector<btScalar>& shear);

  /// Lets what arrived at a node in this step join it at once: mixes in its momentum, which otherwise waits for the
  /// commit. For an effect that makes water leave the node, and wants the velocity that this water has.
  void joinArrivals(std::size_t node) { m_masses.joinArrival(m_water, node); }
  /// The same at all nodes: their masses are then Water::totalMass().
  void joinArrivals();

  /// Whether the world is a btDeformableMultiBodyDynamicsWorld.
  bool isInDeformableWorld() const { return m_deformable; }

  /// A plain message through the world's log callback.
  void log(const std::string& message) const;

 private:
  friend class WetClothWorld;
  WetCloth(WetClothWorld& world, btSoftBody& body, std::vector<Fabric> fabrics, std::vector<int> fabricOfNode,
           bool deformable);

  /// First of all, before any cloth's step(): observe. Never throws.
  void observe(const Step& step);
  /// Before Bullet predicts: sources, transport, losses, material, commit, forces, elasticity. Never throws.
  void step(const Step& step);
  /// After the steps of all cloths: what another one gave or took since this one's own commit.
  void commitExchange();
  /// After that: Bullet makes the tree of faces in the step after links, faces or masses were set, and does not come
  /// back from a mesh of several parts. There it gets ours.
  void spareBulletTheFaceTree();
  /// Between Bullet's collision detection and its solve: contact. Never throws.
  void stepContacts(const Step& step);

  Effect& add(std::unique_ptr<Effect> effect, const void* type);
  void apply(Stage first, Stage last, const Step& step);
  void moveWater(const Step& step);
  void commitIfDue(bool isAtRest);
  /// Where ClothSolver steps the body: effects work on its arrays.
  void followSolver();
  /// The stiffness of links.
  void tellSolver();
  void releaseNodes();
  void commit();
  bool isAwake(const Step& step);
  bool wakesBy(const Step& step);
  /// Whether the body, which is in the world, is the one that was added. One that came back may be another that an
  /// allocator has put at its address: it is the same if it has stepped, or is in all as we left it.
  bool isOfThisBody();
  /// Whether the world was deleted with the body in it. The body, which must be there, is looked at.
  bool lostItsWorld() const { return m_wasPresent && m_watch.lostItsWorld(); }
  void followRestLengths();
  void followBody();
  void takeOverMasses();
  void followCut() const;
  void adaptToBody();
  void attachAgain();
  void transferState(StateArchive& archive);
  void transferMesh(StateArchive& archive);
  std::size_t checked(int node) const;

  WetClothWorld& m_world;
  btSoftBody& m_body;
  std::vector<Fabric> m_fabrics;
  bool m_deformable;
  Water m_water;
  NodeMasses m_masses;
  LinkConstants m_linkConstants;
  RestLengths m_restLengths;
  PackedNodes m_packedNodes;
  std::optional<RestMesh> m_restMesh;
  EffectList m_effects;
  BodyWatch m_watch;
  WaterPace m_pace;
  WaterClock m_waterClock;
  double m_massAsleep = 0;                // when Bullet let the body sleep, 0 while it is awake [kg]
  unsigned long long m_orderOfNodes = 0;  // PackedNodes::order() that effects are attached to
  bool m_nodesAreBehind = false;          // packed velocities wait for ClothSolver
  bool m_wasPresent = true;
  bool m_hasStepped = false;
  bool m_hasJustBegun = false;  // the body's first step is this one or was the last
  bool m_isReplaced = false;    // by another body at the same address
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
