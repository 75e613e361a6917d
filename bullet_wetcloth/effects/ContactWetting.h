// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Effect.h"
#include "bullet_wetcloth/numerics/SideShares.h"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

#include <limits>
#include <string>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class FaceContacts;
struct FaceContact;
struct RigidContact;

/// Water that a node takes from a film in dt, exact for any dt: from dw/dt = k A (1 - w/C),
/// (C - w) (1 - exp(-k A dt / C)), and no more than the film has.
/// @param held, capacity  w and C [kg]
/// @param conductance  k A dt: rate x area x dt [kg]
/// @param film  what is there [kg]
WETCLOTH_EXPORT double filmUptake(double held, double capacity, double conductance, double film);

/// Water that goes from a to b in dt when it flows by the difference of their saturations, exact for any dt: from
/// dw_b/dt = G (s_a - s_b), (s_a - s_b) (1 - exp(-G dt (r_a + r_b))) / (r_a + r_b); < 0 when it goes from b to a.
/// @param difference  s_a - s_b [-]
/// @param responseA, responseB  change of the saturation per water, r: 1/capacity for a node [1/kg], sum > 0
/// @param conductance  G dt [kg]
WETCLOTH_EXPORT double equalisingFlow(double difference, double responseA, double responseB, double conductance);

/// Wets a cloth where it touches something wet: a rigid body with a film of water on it, or another WetCloth.
///
/// Water goes by the difference of saturation: a film counts as 1. A node takes up through its own area, which its
/// contacts with wet bodies share: Bullet lists one for each part of a compound and each triangle of a mesh that is
/// near. Where two cloths touch, Bullet lists contacts of the nodes of each with the triangles of the other, so each of
/// these has half of its node's area, shared between the contacts that the node has. Several cloths on the same side of
/// a node share its area there: k of them at one place give what one does. What one cloth gives is `dripped` in its
/// ledger and `absorbed` in the other's; it brings the velocity of the node that it leaves, a film's that of its body.
///
/// Where the guard of a ClothSolver keeps cloths apart, its contacts take the place of Bullet's (docs/guard.md), and
/// there are those of a cloth with itself, too: water that goes from layer to layer counts as dripped and as absorbed.
///
/// Where drops fly (Drops), a cloth takes up what landed on the bodies that it touches, too, each node what is where it
/// touches. A body needs not to be among `wetBodies` for that.
///
/// One of two cloths needs the effect. If both have it, the one that was added to the WetClothWorld first sees to the
/// pair. Contacts are those of the last substep; of a sleeping cloth those of when it fell asleep, but for a rigid body
/// that has been moved since. The first step in which another cloth is met may allocate.
class WETCLOTH_EXPORT ContactWetting : public Effect {
 public:
  /// A rigid body (or any collision object that is not soft) with water on it.
  struct WetBody {
    const btCollisionObject* body = nullptr;                 ///< told by its address
    double water = std::numeric_limits<double>::infinity();  ///< film on it [kg], [0, inf]
  };

  /// What can be set, with units and ranges. Checked when the effect is made, and by setParameters().
  struct Parameters {
    std::vector<WetBody> wetBodies = {};  ///< each body once
    /// Exchange water with other WetCloths that touch. Both bodies then need fCollision::VF_SS (position-based worlds)
    /// or VF_DD (deformable) in m_cfg.collisions, without which Bullet lists no such contacts.
    bool cloths = false;
    /// Per area and difference of saturation [kg/(m^2 s)], [0, inf). As fast as Absorption wets cotton of 150 g/m^2:
    /// 0.84 x 0.150 kg/m^2 / 8.844 s.
    double rate = 0.0142;
  };

  /// Throws std::invalid_argument naming the field and the value.
  explicit ContactWetting(Parameters parameters);

  /// With the films as they are now, less what cloths have taken.
  const Parameters& parameters() const { return m_parameters; }
  /// Between steps, and all or nothing: throws as the constructor does, or when Bullet does not list the contacts that
  /// are asked for, and then nothing has changed. The films are from now on as given.
  void setParameters(Parameters parameters);
  /// Water on a body from now on [kg], [0, inf]; a body that is not known yet is added. Beside setParameters(), since a
  /// film is a state that changes in each step: this wets one body, whatever is on the others. Throws
  /// std::invalid_argument, also when Bullet lists no contacts with rigid bodies; nothing has changed then.
  void setFilm(const btCollisionObject& body, double water);
  /// Water left on a body [kg]; 0 for one that is not known.
  double film(const btCollisionObject& body) const;

  const char* name() const override { return "ContactWetting"; }
  Stage stage() const override { return Stage::sources; }
  /// Throws std::invalid_argument when Bullet does not list the contacts that are asked for, with the reason.
  void attach(WetCloth& cloth) override;
  void apply(WetCloth& cloth, const Step& step) override;
  void transferState(StateArchive& archive) override;

  /// Times that water went to or from a node: for tests that count work.
  long long nodesVisited() const { return m_nodesVisited; }

 private:
  void requireContacts(const Parameters& parameters) const;
  double* filmOn(const btCollisionObject* body);
  void takeFromOwnFilms(WetCloth& cloth, const Step& step);
  void takeFromLandedDrops(WetCloth& cloth, const Step& step);
  template <class FilmAt, class Visit>
  void visitFilms(WetCloth& cloth, const FilmAt& filmAt, Visit visitor);
  int& contactsWith(const RigidContact& contact);
  template <class FilmAt, class Took>
  void takeFromFilms(WetCloth& cloth, const Step& step, const FilmAt& filmAt, const Took& took);
  double takeFromFilm(WetCloth& cloth, const Step& step, const RigidContact& contact, int corner, double& film);
  bool isSeenToBy(const WetCloth& cloth, const WetCloth& other) const;
  void exchange(WetCloth& nodesOf, WetCloth& facesOf, const Step& step);
  void exchange(WetCloth& nodesOf, WetCloth& facesOf, const FaceContact& contact, double conductance);
  void shareSides(WetCloth& nodesOf, WetCloth& facesOf);
  double shareOf(const WetCloth& nodesOf, const WetCloth& facesOf, const FaceContact& contact) const;
  void give(WetCloth& from, int fromNode, WetCloth& to, int toNode, double mass);

  Parameters m_parameters;
  std::string m_whyNoRigidContacts;  // empty: Bullet lists them, or the effect is not added yet
  std::string m_whyNoFaceContacts;
  bool m_hasNodeContacts = false;
  std::vector<int> m_contactsOfNode;
  std::vector<int> m_contactsOfTriangle;
  SideShares m_nodeShares;    // of the nodes of the pair that is looked at
  SideShares m_cornerShares;  // of the corners of its triangles
  long long m_nodesVisited = 0;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
