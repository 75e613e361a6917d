// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/BodyMesh.h"
#include "bullet_wetcloth/solver/BodyRecoil.h"
#include "bullet_wetcloth/solver/BodyWays.h"
#include "bullet_wetcloth/solver/ClothGuard.h"
#include "bullet_wetcloth/solver/ConvexHulls.h"
#include "bullet_wetcloth/solver/GuardExemptions.h"
#include "bullet_wetcloth/solver/ShapeFaces.h"
#include "bullet_wetcloth/solver/StandingFaces.h"

#include <BulletSoftBody/btSoftBody.h>

#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Gives a guard the rigid bodies near its cloths: one more cloth, all of whose nodes are imposed. In the small steps
/// of a step each corner goes in a straight line from where its body comes from to where it is now.
class GuardBodies {
 public:
  /// What it needs of a cloth.
  struct Cloth {
    const btSoftBody* body;
    ClothGuard::Cloth guarded;
  };

  /// Before the first small step: which bodies there are.
  /// @param others     nodes of other cloths that the guard has after these
  /// @param thickness  of the guard [m]
  /// @param dt         of the step [s]
  void begin(const std::vector<Cloth>& cloths, int others, double thickness, btScalar dt);
  /// Takes the surfaces that the cloths may come to from where they are now, after this share of the step.
  void gather(const std::vector<Cloth>& cloths, double share);
  /// Whether the cloths are still where all surfaces around were taken.
  bool covers(const std::vector<Cloth>& cloths) const;
  bool isEmpty() const { return m_mesh.nodes() == 0; }
  /// Puts all corners where they are after this share of the step.
  void go(double share);
  /// After a small step of h [s]: what the corners have pushed, see GuardNodes, slows bodies in the next step.
  void recoil(const std::vector<GuardNodes::Place>& recoil, double share, btScalar h);
  /// After the last small step.
  void end();
  /// As if it had seen no step yet.
  void forget() { m_ways.forget(); }
  /// Names what goes on from step to step: see StateArchive.
  void transferState(StateArchive& archive) { m_ways.transferState(archive); }

  /// @param h  of a small step [s]
  ClothGuard::Cloth guarded(btScalar h);
  const GuardExemptions& exemptions() const { return m_exemptions; }
  /// How many faces of cloths stand in a convex body in this step: they and those beside them are not kept from it.
  long long inside() const { return m_inside; }

 private:
  struct Near {
    BodyBox box;   // where a cloth's nodes are, and will be as far as is known [m], from the origin
    BodyBox room;  // for which surfaces are taken
  };

  BodyBox boxOf(const Cloth& cloth) const;
  void bound(const std::vector<Cloth>& cloths);
  void exempt(const std::vector<Cloth>& cloths, std::size_t body, const BodyPose& pose);

  // Of a body, in this step.
  struct Share {
    std::size_t firstNode;
    std::size_t endNode;
    BodyRecoil recoil;
  };

  BodyWays m_ways;
  std::vector<Share> m_shares;  // of each body
  ConvexHulls m_hulls;
  ShapeFaces m_faces;
  BodyMesh m_mesh;
  StandingFaces m_standing;
  GuardExemptions m_exemptions;
  BodyPoint m_origin = {0, 0, 0};  // of the guard [m]
  int m_others = 0;
  double m_thickness = 0;
  double m_edge = 0;  // of the finest cloth, the mean [m]
  double m_dt = 0;
  long long m_inside = 0;
  std::vector<Near> m_near;  // of each cloth
  std::vector<BodyWays::Place> m_places;
  std::vector<BodyBox> m_boxes;
  std::vector<int> m_slots;
  PackedNodes::Lane m_position[3];
  PackedNodes::Lane m_velocity[3];
  PackedNodes::Lane m_other[3];  // nobody uses what is in them
  PackedNodes::Lane m_inverseMass;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
