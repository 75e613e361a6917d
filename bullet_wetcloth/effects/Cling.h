// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Effect.h"
#include "bullet_wetcloth/numerics/WetnessCurve.h"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

struct RigidContact;

/// What a bond gives of the impulse that would keep its node in place.
struct BondImpulse {
  btVector3 impulse = btVector3(0, 0, 0);  ///< on the node [N s]
  bool breaks = false;                     ///< pulled harder than it holds, or not finite: no impulse at all
  bool slides = false;                     ///< held back along the surface by less than it takes
};

/// An adhesive bond: it holds against a pull away from the surface up to `pull`, and breaks beyond; it holds along the
/// surface up to `shear`, and slides beyond; and it never pushes away.
/// @param needed  the impulse that would keep the node in place [N s]
/// @param normal  out of the surface, of length 1
/// @param pull, shear  stress x area x dt [N s], >= 0
WETCLOTH_EXPORT BondImpulse bondImpulse(const btVector3& needed, const btVector3& normal, double pull, double shear);

/// Holds a wet cloth on a surface that it touches, until it is pulled off with more than a force per area.
///
/// A node that Bullet reports in contact with a rigid body, and that is wet enough, is bonded to the place where it
/// is. A bond gives the impulse that keeps the node on its place: pulls up to adhesion x area x dt, and along the
/// surface up to shear strength x area x dt, beyond which the place moves on. A stronger pull breaks it, and then
/// nothing acts on the node; it may bond again when Bullet reports a contact again. The other side of each impulse
/// acts on the rigid body, at the node's place. What the body bears otherwise (links, springs, wind) is felt through
/// the velocities that it gave the node a step before.
///
/// A bond ends, too, where the body's surface ends: when its place is past an edge, or the body got another shape or
/// scale, or either was put elsewhere, or the body left the world. A place is on the body while it is nearer to its
/// shape than one and a half times the cloth's collision margin (and 1 mm). A cloth that sleeps does not notice a
/// change inside a compound or a mesh.
///
/// While Bullet still reports the contact, the weight alone decides whether the bond breaks: velocities away from the
/// surface are then Bullet's own, getting the node out of the collision margin, and are held within the same limit.
///
/// Layers that the guard of a ClothSolver keeps apart, of two cloths or of one, hold each other in the same way, with
/// the mean of both stresses: a cloth without Cling, or too dry, adds nothing. That is no bond but lasts as long as the
/// layers touch (docs/guard.md), in each small step, whatever pulls them apart.
///
/// Objects without contact response and links of multi-bodies are left out. Stresses follow the saturation: 0 at
/// `minimumSaturation` and below, all at `peakSaturation`, `floodedShare` at 1.
class WETCLOTH_EXPORT Cling : public Effect {
 public:
  /// What can be set, with units and ranges. Checked when the effect is made, and by setParameters().
  struct Parameters {
    double adhesion = 50;            ///< pull that a bond holds [Pa], [0, inf)
    double shearStrength = 20;       ///< along the surface [Pa], [0, inf)
    double minimumSaturation = 0.1;  ///< no bond at and below, [0, 1)
    double peakSaturation = 0.5;     ///< (minimumSaturation, 1]
    double floodedShare = 0.5;       ///< of both stresses, at saturation 1 [-], [0, 1]; unused if peakSaturation is 1
  };

  /// Throws std::invalid_argument naming the field and the value.
  explicit Cling(Parameters parameters);

  /// As last set.
  const Parameters& parameters() const { return m_parameters; }
  /// Between steps, and all or nothing: throws as the constructor does, and then nothing has changed. Bonds stay, and
  /// are held by the new stresses.
  void setParameters(Parameters parameters);

  /// Share of the stresses at a saturation, [0, 1].
  double share(double saturation) const;

  /// Nodes that are held now.
  int bonds() const { return m_bondCount; }
  /// Whether this node is held now; false for one that the body has not.
  bool isBonded(int node) const {
    return node >= 0 && static_cast<std::size_t>(node) < m_bonds.size() &&
           m_bonds[static_cast<std::size_t>(node)].object != nullptr;
  }

  const char* name() const override { return "Cling"; }
  Stage stage() const override { return Stage::forces; }
  /// Throws std::invalid_argument when Bullet lists no contacts of this body's nodes, with the reason.
  void attach(WetCloth& cloth) override;
  void detach(WetCloth& cloth) override;
  void apply(WetCloth& cloth, const Step& step) override;
  /// When what it clings to has moved away, or is gone.
  bool wakes(const WetCloth& cloth, const Step& step) const override;
  void transferState(StateArchive& archive) override;

  /// Bonds looked at so far: for tests that count work.
  long long nodesVisited() const { return m_nodesVisited; }

 private:
  struct Bond {
    btCollisionObject* object = nullptr;      // null: no bond
    int proxy = 0;                            // of the broadphase, which tells it from one at the same address
    const btCollisionShape* shape = nullptr;  // told by its address
    btVector3 scaling = btVector3(0, 0, 0);
    btVector3 anchor = btVector3(0, 0, 0);  // where the node is held, in the object's frame
    btVector3 seen = btVector3(0, 0, 0);    // where the node was a step ago, in the object's frame
    btVector3 normal = btVector3(0, 0, 0);  // in the object's frame
    double gap = 0;                         // the smallest that Bullet reports [m]
    bool isReported = false;                // by Bullet, in the last substep
  };

  bool knowsContacts(const WetCloth& cloth, const Step& step);
  void renew(WetCloth& cloth, const Step& step, bool knowsContacts);
  void take(WetCloth& cloth, const Step& step, const RigidContact& contact);
  bool isSteady(const WetCloth& cloth, const Step& step, std::size_t i) const;
  bool isOn(const WetCloth& cloth, const Step& step, std::size_t i);
  void hold(WetCloth& cloth, const Step& step, std::size_t i);
  static bool hasShapeOf(const Bond& bond);
  static void rememberShape(Bond& bond);
  void release(Bond& bond);
  void holdLayers(WetCloth& cloth);
  static void transferBond(StateArchive& archive, Bond& bond);

  Parameters m_parameters;
  WetnessCurve m_curve;
  std::vector<Bond> m_bonds;  // by node
  int m_bondCount = 0;
  std::vector<btScalar> m_pull;   // by node: what holds it on another layer [N]
  std::vector<btScalar> m_shear;  // and along it [N]
  double m_nextTime = -1;         // of a step without sleep in between [s]; < 0: none before
  long long m_nodesVisited = 0;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
