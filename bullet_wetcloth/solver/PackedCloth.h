// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/AnchorProjection.h"
#include "bullet_wetcloth/solver/ClothGuard.h"
#include "bullet_wetcloth/solver/ClothSolver.h"
#include "bullet_wetcloth/solver/CoincidentNodes.h"
#include "bullet_wetcloth/solver/ContactProjection.h"
#include "bullet_wetcloth/solver/FacesByNodes.h"
#include "bullet_wetcloth/solver/LocalNodes.h"
#include "bullet_wetcloth/solver/NodeNormals.h"
#include "bullet_wetcloth/solver/PackedLinks.h"
#include "bullet_wetcloth/solver/PinnedWays.h"
#include "bullet_wetcloth/solver/RigidDetection.h"
#include "bullet_wetcloth/solver/SmallStepCount.h"
#include "bullet_wetcloth/solver/SmallStepViewers.h"
#include "bullet_wetcloth/solver/Tethers.h"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletSoftBody/btSoftBody.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class StateArchive;

/// One body that ClothSolver has taken: the parts of its step, in their order.
class PackedCloth {
 public:
  explicit PackedCloth(btSoftBody& body) : m_body(body), m_nodes(body) {}

  btSoftBody& body() { return m_body; }
  const btSoftBody& body() const { return m_body; }
  /// The node that is not finite, which keeps the cloth from being stepped; -1: none.
  int badNode() const { return m_nodes.badNode(); }
  /// How often its links were taken over: when the body or its links have changed.
  unsigned long long linksTaken() const { return m_linksTaken; }
  /// As many small steps as its links need in 1/60 s to stretch no further than their stiffness says.
  int smallStepsFor() const;
  /// As many as its next step has, if that is dt [s] long for the world.
  int smallStepsIn(const ClothSolver::Parameters& parameters, double dt) const;

  /// Names what goes on from step to step: see StateArchive.
  void transferState(StateArchive& archive);

  /// The nodes' arrays; not those of the body's present mesh while it hasNewMesh().
  PackedNodes& nodes() { return m_nodes; }
  /// Whether the body was cut, or is another one, since its mesh was taken.
  bool hasNewMesh() const;
  /// Takes the mesh when it is a new one.
  void followMesh();
  /// Before the step: the mesh, and the links as they are now.
  void follow(const ClothSolver::Parameters& parameters, btScalar dt);
  /// Set anew before each step.
  LayerWetness& wetness() { return m_wetness; }
  /// Scales the stiffness of each link; empty: of none. The revision tells whether these are others than before.
  void setLinkStiffness(const std::vector<btScalar>& factors, unsigned long long revision);
  /// Takes over the nodes, and predicts where they will be. False: the cloth rests in this step.
  bool predict(btScalar dt);
  /// Whether, since this was asked last, free nodes were put elsewhere or moved without a guard.
  bool takePlaced() { return m_nodes.takePlaced(); }
  /// Whether nodes that counted as one have come apart since this was asked last.
  bool separateCoincident();
  /// Finds the contacts with a rigid body or a link of a multibody.
  void collide(const btCollisionObjectWrapper& object);
  /// All small steps.
  void solve(const ClothSolver::Parameters& parameters, SmallStepViewers& viewers);
  /// The same, one by one. False: there are none in this step.
  bool beginSmallSteps(const ClothSolver::Parameters& parameters);
  int smallSteps() const { return m_count; }
  void takeSmallStep(int index);
  void show(SmallStepViewers& viewers, int index);
  void endSmallSteps();
  /// What a guard needs of it between them.
  ClothGuard::Cloth guarded();
  /// The same of one that has no small steps, since it sleeps or its time stands still; nothing when a node is not
  /// finite.
  std::optional<ClothGuard::Cloth> standing();
  const FacesByNodes& facesByNodes();
  /// Writes back what Bullet and applications read.
  void finish();

 private:
  void takeMesh();
  void takeLinks(const ClothSolver::Parameters& parameters);
  bool linksSeemChanged(const ClothSolver::Parameters& parameters);
  btScalar complianceOf(const btSoftBody::Link& link, std::size_t index,
                        const ClothSolver::Parameters& parameters) const;
  bool isCrumpled() const;
  btScalar rounding() const;
  LinkedNodes linked();
  const btScalar* settledOf(int axis) const;
  void updateBounds();
  void updateFaceTree();
  void makeGuardMesh();
  void transferGuardMesh(StateArchive& archive);

  btSoftBody& m_body;
  LocalNodes m_nodes;
  std::size_t m_tiles = 1;  // of the nodes' slots
  std::optional<NodeSlots::Grid> m_grid;
  PackedLinks m_links;
  NodeNormals m_normals;
  RigidDetection m_detection;
  ContactProjection m_contacts;
  AnchorProjection m_anchors;
  Tethers m_tethers;
  SmallStepCount m_smallSteps;
  SmallStep m_step = {};  // each of this step
  int m_count = 0;
  std::unique_ptr<GuardMesh> m_guardMesh;        // while it is guarded
  std::vector<btVector3> m_guardPlaces;          // by which it was made [m]
  double m_guardEdge = 0;                        // its mean edge then [m]
  CoincidentNodes m_coincident;                  // of it
  PackedNodes::Lane m_settled[3];                // velocities at the end of the last step that was guarded [m/s]
  std::unique_ptr<FacesByNodes> m_facesByNodes;  // once its contacts are listed
  PinnedWays m_pins;
  LayerWetness m_wetness;
  bool m_isGuarded = false;
  std::vector<btScalar> m_weights;  // of each link: the sum of its ends' inverse masses when the mesh was taken
  std::vector<btScalar> m_stiffnessFactors;  // of each link, or none
  unsigned long long m_stiffnessRevision = 0;
  const void* m_mesh[2] = {};  // addresses of nodes and links
  int m_counts[3] = {};        // nodes, links, faces
  std::size_t m_nextLink = 0;  // to look at
  unsigned long long m_linksTaken = 0;
  double m_stiffness = 0;  // that the links were taken with
  btScalar m_dt = 0;       // with which soft links were taken
  bool m_isPredicted = false;
  bool m_isSolved = false;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
