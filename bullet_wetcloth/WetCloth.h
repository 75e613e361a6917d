// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Effect.h"
#include "bullet_wetcloth/Fabric.h"
#include "bullet_wetcloth/mesh/RestMesh.h"
#include "bullet_wetcloth/shading/Colour.h"
#include "bullet_wetcloth/water/NodeMasses.h"
#include "bullet_wetcloth/water/Water.h"

#include <BulletSoftBody/btSoftBody.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class WetClothWorld;

/// One btSoftBody of an application, its water, its fabric and its effects. Made by WetClothWorld::add().
///
/// Units are SI. Nodes are numbered as in btSoftBody::m_nodes.
class WETCLOTH_EXPORT WetCloth {
 public:
  WetCloth(const WetCloth&) = delete;
  WetCloth& operator=(const WetCloth&) = delete;
  ~WetCloth();

  btSoftBody& body() { return m_body; }
  const btSoftBody& body() const { return m_body; }
  const Fabric& fabric() const { return m_fabric; }

  // --- effects ----------------------------------------------------------------------------------------------

  /// Adds an effect, for example `towel.add<Wind>({btVector3(4, 0, 1)})`, and returns it.
  /// Throws std::invalid_argument when a parameter is out of range or the body lacks what the effect needs;
  /// the cloth is then as it was.
  template <class E>
  E& add(typename E::Parameters parameters = {}) {
    auto effect = std::make_unique<E>(std::move(parameters));
    E& reference = *effect;
    add(std::unique_ptr<Effect>(std::move(effect)));
    return reference;
  }
  /// Adds an effect of your own. Throws std::invalid_argument on null, and what its attach() throws.
  Effect& add(std::unique_ptr<Effect> effect);
  /// Removes an effect of this cloth. Throws std::invalid_argument when it is not one of them.
  void remove(Effect& effect);
  /// In the order in which the step runs them.
  const std::vector<std::unique_ptr<Effect>>& effects() const { return m_effects; }

  // --- water ------------------------------------------------------------------------------------------------

  int nodeCount() const { return static_cast<int>(m_water.size()); }
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
  Ledger ledger() const { return m_water.ledger(); }

  /// Sets every node to this saturation, [0, 1], and commits the masses. Velocities stay.
  void setSaturation(double saturation);
  /// Sets the water of each node [kg], one finite value >= 0 per node, and commits the masses. Velocities stay.
  /// Throws std::invalid_argument naming the node and the value.
  void setHeld(const std::vector<double>& held);

  // --- looks ------------------------------------------------------------------------------------------------

  /// Diffuse colour of a node, linear RGB (Lekner & Dorf 1988). Computed when asked. Throws std::out_of_range.
  Colour colour(int node) const;
  /// Roughness of a node for a renderer, [0, 1]. Throws std::out_of_range.
  double roughness(int node) const;

  // --- for effects ------------------------------------------------------------------------------------------

  WetClothWorld& world() { return m_world; }
  const WetClothWorld& world() const { return m_world; }
  Water& water() { return m_water; }
  const Water& water() const { return m_water; }
  NodeMasses& masses() { return m_masses; }
  /// The cloth's triangles at rest. Built when first asked for, and again after the body's nodes, links or faces
  /// changed in number: ask in attach(), which is called then.
  const RestMesh& restMesh();

  /// Adds to a free node's velocity, in the way that each of Bullet's worlds takes notice of.
  /// Pinned nodes and values that are not finite are ignored.
  void push(btSoftBody::Node& node, const btVector3& deltaVelocity) {
    const btScalar size = deltaVelocity.x() + deltaVelocity.y() + deltaVelocity.z();
    if (node.m_im == 0 || !(size - size == 0)) return;
    node.m_v += deltaVelocity;
    // The deformable world's implicit solve starts from the velocity at the end of the last step.
    if (m_deformable) node.m_vn += deltaVelocity;
  }

  /// Lets what arrived at a node in this step join it at once: mixes in its momentum, which otherwise waits for the
  /// commit. For an effect that makes water leave the node, and wants the velocity that this water has.
  void joinArrivals(std::size_t node) { m_masses.joinArrival(m_water, node); }
  /// The same at all nodes: their masses are then Water::totalMass().
  void joinArrivals();

  bool isInDeformableWorld() const { return m_deformable; }

  /// A plain message through the world's log callback.
  void log(const std::string& message) const;

 private:
  friend class WetClothWorld;
  WetCloth(WetClothWorld& world, btSoftBody& body, Fabric fabric, bool deformable);

  /// Before Bullet predicts: sources, transport, losses, material, commit, forces, elasticity. Never throws.
  void step(const Step& step);
  /// Between Bullet's collision detection and its solve: contact. Never throws.
  void stepContacts(const Step& step);
  /// After the steps of all cloths: what another one gave or took since this one's own commit.
  void commitExchange();
  bool hasContactEffects() const { return !m_effects.empty() && m_effects.back()->stage() == Stage::contact; }
  bool isAwake(const Step& step);
  void adaptToBody();
  void releaseEffects();
  void detachGuarded(Effect& effect);
  template <class Action>
  void guarded(std::size_t& index, Action action);
  bool bodyChanged() const;
  void transferState(StateArchive& archive);
  void transferMesh(StateArchive& archive);
  void rememberBody();
  std::size_t checked(int node) const;

  WetClothWorld& m_world;
  btSoftBody& m_body;
  Fabric m_fabric;
  bool m_deformable;
  Water m_water;
  NodeMasses m_masses;
  std::optional<RestMesh> m_restMesh;
  std::vector<std::unique_ptr<Effect>> m_effects;
  double m_massAsleep = 0;  // when Bullet let the body sleep, 0 while it is awake [kg]
  bool m_wasPresent = true;
  int m_nodeCount = 0;
  int m_linkCount = 0;
  int m_faceCount = 0;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
