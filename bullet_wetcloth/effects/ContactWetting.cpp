// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/effects/ContactWetting.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/WetCloth.h"
#include "bullet_wetcloth/WetClothWorld.h"
#include "bullet_wetcloth/bullet/Contacts.h"
#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/numerics/ContactArea.h"
#include "bullet_wetcloth/state/StateArchive.h"
#include "bullet_wetcloth/water/BodyFilms.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

void requireFilm(const std::string& field, double water) {
  if (!(water >= 0)) rejectValue(field, water, ">= 0 (infinite is allowed)");
}

void requireValid(const ContactWetting::Parameters& parameters) {
  requireNotNegative("ContactWetting.rate", parameters.rate);
  const std::vector<ContactWetting::WetBody>& bodies = parameters.wetBodies;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const std::string field = "ContactWetting.wetBodies[" + std::to_string(i) + "]";
    if (!bodies[i].body) reject(field + ".body", "must not be null");
    requireFilm(field + ".water", bodies[i].water);
    for (std::size_t k = 0; k < i; ++k) {
      if (bodies[k].body == bodies[i].body) reject(field + ".body", "is there twice");
    }
  }
}

// The part of `mass` that a node has room for, so that not even a rounding goes above its capacity.
double fitting(const Water& water, std::size_t node, double mass) {
  const double capacity = water.capacity(node);
  const double held = water.held(node);
  const double most = std::max(0.0, capacity - held);
  return std::min(mass, held + most > capacity ? std::nextafter(most, 0.0) : most);
}

btVector3 velocityOf(const btCollisionObject& object, const btVector3& place) {
  const btRigidBody* rigid = btRigidBody::upcast(&object);
  if (!rigid) return {0, 0, 0};
  return rigid->getVelocityInLocalPoint(place - rigid->getCenterOfMassPosition());
}

// The contacts of a body that sleeps are those of when it fell asleep, and the object may have been taken away since.
bool isGone(const WetCloth& cloth, const RigidContact& contact) {
  if (!contact.deformable || cloth.body().isActive() || !btRigidBody::upcast(contact.object)) return false;
  btVector3 place(0, 0, 0);
  for (std::size_t k = 0; k < static_cast<std::size_t>(contact.point.count); ++k) {
    place += cloth.body().m_nodes[contact.point.nodes[k]].m_x * static_cast<btScalar>(contact.point.weights[k]);
  }
  const btVector3 arm = place - contact.object->getWorldTransform().getOrigin();
  return (arm - contact.deformable->m_c1).length2() > kContactMotionTolerance * kContactMotionTolerance;
}

// Its arrays are those of the body as it was when it was last looked at.
bool isUpToDate(const WetCloth& cloth) { return cloth.nodeCount() == cloth.body().m_nodes.size(); }

bool wetsCloths(const WetCloth& cloth) {
  bool wets = false;
  cloth.forEach<ContactWetting>([&](const ContactWetting& effect) { wets = wets || effect.parameters().cloths; });
  return wets;
}

// The cloths of the world that water goes to or from, be it by this one's effect or by theirs.
template <class Visit>
void visitPartners(WetCloth& cloth, Visit visit) {
  const btAlignedObjectArray<btSoftBody*>& bodies = cloth.world().softBodies();
  for (int i = 0; i < bodies.size(); ++i) {
    WetCloth* const other = bodies[i] == &cloth.body() ? nullptr : cloth.world().find(*bodies[i]);
    if (other && isUpToDate(*other) && (wetsCloths(cloth) || wetsCloths(*other))) visit(*other);
  }
}

SideShares::Side sideOf(const WetCloth& cloth, int node, const btVector3& towards) {
  return SideShares::sideOf(cloth.body().m_nodes[node].m_n, towards);
}

// By which the node is wetter than the point of the triangle that it touches.
double differenceAt(const WetCloth& nodesOf, const WetCloth& facesOf, const FaceContact& contact) {
  double faceSaturation = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    faceSaturation += contact.point.weights[k] * facesOf.water().saturation(toSize(contact.point.nodes[k]));
  }
  return nodesOf.water().saturation(toSize(contact.node)) - faceSaturation;
}

double areaOf(WetCloth& cloth, int node) {
  const std::size_t i = toSize(node);
  return contactArea(cloth.restMesh(), cloth.water(), cloth.fabricOf(i).arealDensity, i);
}

}  // namespace

double filmUptake(double held, double capacity, double conductance, double film) {
  const double missing = capacity - held;
  if (!(missing > 0)) return 0;
  double taken = missing * -std::expm1(-conductance / capacity);
  if (conductance > 0 && missing - taken <= kNegligible * capacity) taken = missing;
  return std::min(taken, film);
}

double equalisingFlow(double difference, double responseA, double responseB, double conductance) {
  const double response = responseA + responseB;
  return difference * -std::expm1(-conductance * response) / response;
}

ContactWetting::ContactWetting(Parameters parameters) { setParameters(std::move(parameters)); }

void ContactWetting::setParameters(Parameters parameters) {
  requireValid(parameters);
  requireContacts(parameters);
  m_parameters = std::move(parameters);
}

void ContactWetting::requireContacts(const Parameters& parameters) const {
  if (!parameters.wetBodies.empty() && !m_whyNoRigidContacts.empty()) {
    reject("ContactWetting.wetBodies", m_whyNoRigidContacts);
  }
  if (parameters.cloths && !m_whyNoFaceContacts.empty()) reject("ContactWetting.cloths", m_whyNoFaceContacts);
}

void ContactWetting::setFilm(const btCollisionObject& body, double water) {
  requireFilm("ContactWetting.water", water);
  if (!m_whyNoRigidContacts.empty()) reject("ContactWetting.wetBodies", m_whyNoRigidContacts);
  if (double* film = filmOn(&body)) {
    *film = water;
  } else {
    m_parameters.wetBodies.push_back({&body, water});
  }
}

double ContactWetting::film(const btCollisionObject& body) const {
  for (const WetBody& wet : m_parameters.wetBodies) {
    if (wet.body == &body) return wet.water;
  }
  return 0;
}

double* ContactWetting::filmOn(const btCollisionObject* body) {
  for (WetBody& wet : m_parameters.wetBodies) {
    if (wet.body == body) return &wet.water;
  }
  return nullptr;
}

void ContactWetting::attach(WetCloth& cloth) {
  m_whyNoRigidContacts = whyNoRigidContacts(cloth.body(), cloth.isInDeformableWorld());
  m_whyNoFaceContacts = whyNoFaceContacts(cloth.body(), cloth.isInDeformableWorld());
  requireContacts(m_parameters);
  m_hasNodeContacts = whyNoNodeContacts(cloth.body(), cloth.isInDeformableWorld()).empty();
  cloth.restMesh();
  m_contactsOfNode.resize(std::max(m_contactsOfNode.size(), cloth.water().size()));
  m_contactsOfTriangle.resize(cloth.restMesh().triangles().size());
}

void ContactWetting::apply(WetCloth& cloth, const Step& step) {
  if (!m_parameters.wetBodies.empty()) takeFromOwnFilms(cloth, step);
  takeFromLandedDrops(cloth, step);
  if (!m_parameters.cloths) return;
  visitPartners(cloth, [&](WetCloth& other) {
    if (isSeenToBy(cloth, other)) return;
    exchange(cloth, other, step);
    exchange(other, cloth, step);
  });
  // The guard of a ClothSolver lists what a cloth has of itself, Bullet's position-based worlds do not.
  if (!cloth.isInDeformableWorld()) exchange(cloth, cloth, step);
}

void ContactWetting::takeFromOwnFilms(WetCloth& cloth, const Step& step) {
  takeFromFilms(
      cloth, step, [&](const RigidContact& contact, int /*node*/) { return filmOn(contact.object); },
      [](double /*taken*/) {});
}

void ContactWetting::takeFromLandedDrops(WetCloth& cloth, const Step& step) {
  BodyFilms* const films = cloth.world().films();
  if (!films || films->empty() || !m_whyNoRigidContacts.empty()) return;
  const btScalar margin = cloth.body().getCollisionShape()->getMargin();
  // Where the node's contact is on the body: the film is there.
  const auto filmAt = [&](const RigidContact& contact, int node) {
    const btScalar height = static_cast<btScalar>(contact.gap) + margin;
    return films->find(*contact.object, cloth.body().m_nodes[node].m_x - contact.normal * height);
  };
  takeFromFilms(cloth, step, filmAt, [&](double taken) { films->took(taken); });
}

// Contacts with bodies that have water. A cloth whose nodes and triangles both collide lists what touches twice.
template <class FilmAt, class Visit>
void ContactWetting::visitFilms(WetCloth& cloth, const FilmAt& filmAt, Visit visitor) {
  RigidContacts(cloth.body(), cloth.world().world(), cloth.isInDeformableWorld())
      .visit([&](const RigidContact& contact) {
        if (contact.face >= 0 && m_hasNodeContacts) return;
        bool isWet = false;
        for (int k = 0; k < contact.point.count; ++k) {
          const double* const film = filmAt(contact, contact.point.nodes[static_cast<std::size_t>(k)]);
          isWet = isWet || (film && *film > 0);
        }
        if (isWet && !isGone(cloth, contact)) visitor(contact);
      });
}

int& ContactWetting::contactsWith(const RigidContact& contact) {
  if (contact.face >= 0) return m_contactsOfTriangle[static_cast<std::size_t>(contact.face)];
  return m_contactsOfNode[static_cast<std::size_t>(contact.point.nodes[0])];
}

template <class FilmAt, class Took>
void ContactWetting::takeFromFilms(WetCloth& cloth, const Step& step, const FilmAt& filmAt, const Took& took) {
  visitFilms(cloth, filmAt, [&](const RigidContact& contact) { contactsWith(contact) = 0; });
  visitFilms(cloth, filmAt, [&](const RigidContact& contact) { ++contactsWith(contact); });
  visitFilms(cloth, filmAt, [&](const RigidContact& contact) {
    for (int k = 0; k < contact.point.count; ++k) {
      double* const film = filmAt(contact, contact.point.nodes[static_cast<std::size_t>(k)]);
      if (film) took(takeFromFilm(cloth, step, contact, k, *film));
    }
  });
}

double ContactWetting::takeFromFilm(WetCloth& cloth, const Step& step, const RigidContact& contact, int corner,
                                    double& film) {
  const int node = contact.point.nodes[static_cast<std::size_t>(corner)];
  const std::size_t i = static_cast<std::size_t>(node);
  Water& water = cloth.water();
  const double whole = contact.face < 0 ? areaOf(cloth, node)
                                        : cloth.restMesh().triangles()[static_cast<std::size_t>(contact.face)].area;
  const double area = whole / contactsWith(contact);
  const double conductance =
      m_parameters.rate * area * contact.point.weights[static_cast<std::size_t>(corner)] * step.dt;
  const double uptake = filmUptake(water.held(i), water.capacity(i), conductance, film);
  const double wanted = fitting(water, i, uptake);
  if (!(wanted > 0)) return 0;
  const btVector3 velocity = velocityOf(*contact.object, cloth.body().m_nodes[node].m_x);
  const double before = water.held(i);
  water.absorb(i, wanted, velocity.x(), velocity.y(), velocity.z());
  const double taken = std::min(film, water.held(i) - before);
  film -= taken;
  ++m_nodesVisited;
  return taken;
}

// Whether the other cloth has the effect, too, and was added first.
bool ContactWetting::isSeenToBy(const WetCloth& cloth, const WetCloth& other) const {
  for (const WetCloth& candidate : cloth.world().cloths()) {
    if (&candidate == &cloth) return false;
    if (&candidate == &other) return wetsCloths(other);
  }
  return false;
}

void ContactWetting::exchange(WetCloth& nodesOf, WetCloth& facesOf, const Step& step) {
  FaceContacts contacts(nodesOf.body(), facesOf.body(), nodesOf.isInDeformableWorld());
  if (contacts.size() == 0) return;
  // Allocates when a larger cloth is met for the first time.
  m_contactsOfNode.resize(std::max(m_contactsOfNode.size(), nodesOf.water().size()));
  contacts.visit([&](const FaceContact& contact) { m_contactsOfNode[static_cast<std::size_t>(contact.node)] = 0; });
  bool touch = false;
  contacts.visit([&](const FaceContact& contact) {
    ++m_contactsOfNode[static_cast<std::size_t>(contact.node)];
    touch = true;
  });
  if (!touch) return;
  const bool areMany = &nodesOf != &facesOf && nodesOf.world().cloths().size() > 2;
  if (areMany) shareSides(nodesOf, facesOf);
  contacts.visit([&](const FaceContact& contact) {
    const double share = areMany ? shareOf(nodesOf, facesOf, contact) : 1;
    const double area =
        areaOf(nodesOf, contact.node) / (2.0 * m_contactsOfNode[static_cast<std::size_t>(contact.node)]);
    exchange(nodesOf, facesOf, contact, m_parameters.rate * (share * area) * step.dt);
  });
}

// With all cloths that touch the nodes by their triangles, and with all that touch the triangles by their nodes, each
// by the difference that drives its water: a cloth as wet as this one takes no share.
void ContactWetting::shareSides(WetCloth& nodesOf, WetCloth& facesOf) {
  const bool deformable = nodesOf.isInDeformableWorld();
  int who = 0;
  m_nodeShares.reset(nodesOf.water().size());
  visitPartners(nodesOf, [&](WetCloth& other) {
    ++who;
    FaceContacts(nodesOf.body(), other.body(), deformable).visit([&](const FaceContact& contact) {
      const double difference = std::fabs(differenceAt(nodesOf, other, contact));
      m_nodeShares.add(toSize(contact.node), sideOf(nodesOf, contact.node, -contact.normal), who, difference);
    });
  });
  m_cornerShares.reset(facesOf.water().size());
  visitPartners(facesOf, [&](WetCloth& other) {
    ++who;
    FaceContacts(other.body(), facesOf.body(), deformable).visit([&](const FaceContact& contact) {
      const double wanted = areaOf(other, contact.node) * std::fabs(differenceAt(other, facesOf, contact));
      for (std::size_t k = 0; k < 3; ++k) {
        const int corner = contact.point.nodes[k];
        m_cornerShares.add(toSize(corner), sideOf(facesOf, corner, contact.normal), who,
                           wanted * contact.point.weights[k]);
      }
    });
  });
}

// A corner of the triangle that has little left holds up the whole contact.
double ContactWetting::shareOf(const WetCloth& nodesOf, const WetCloth& facesOf, const FaceContact& contact) const {
  double least = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const int corner = contact.point.nodes[k];
    if (!(contact.point.weights[k] > 0)) continue;
    least = std::min(least, m_cornerShares.share(toSize(corner), sideOf(facesOf, corner, contact.normal)));
  }
  return least * m_nodeShares.share(toSize(contact.node), sideOf(nodesOf, contact.node, -contact.normal));
}

// A triangle's saturation is that of the point that touches, and what it takes or gives is shared out by the same
// weights: so it changes by the sum of b^2 / C per water.
void ContactWetting::exchange(WetCloth& nodesOf, WetCloth& facesOf, const FaceContact& contact, double conductance) {
  const std::size_t node = static_cast<std::size_t>(contact.node);
  double faceResponse = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t corner = static_cast<std::size_t>(contact.point.nodes[k]);
    const double weight = contact.point.weights[k];
    faceResponse += weight * weight / facesOf.water().capacity(corner);
  }
  const double difference = differenceAt(nodesOf, facesOf, contact);
  if (!(std::fabs(difference) > kNegligible)) return;
  const double flow = equalisingFlow(difference, 1 / nodesOf.water().capacity(node), faceResponse, conductance);
  for (std::size_t k = 0; k < 3; ++k) {
    const double share = contact.point.weights[k] * std::fabs(flow);
    if (flow > 0) {
      give(nodesOf, contact.node, facesOf, contact.point.nodes[k], share);
    } else {
      give(facesOf, contact.point.nodes[k], nodesOf, contact.node, share);
    }
  }
}

void ContactWetting::give(WetCloth& from, int fromNode, WetCloth& to, int toNode, double mass) {
  const std::size_t receiver = static_cast<std::size_t>(toNode);
  const double wanted = fitting(to.water(), receiver, mass);
  if (!(wanted > 0)) return;
  from.joinArrivals(static_cast<std::size_t>(fromNode));
  const double moved = from.water().handOver(static_cast<std::size_t>(fromNode), wanted);
  if (!(moved > 0)) return;
  const btVector3& velocity = from.body().m_nodes[fromNode].m_v;
  to.water().absorb(receiver, moved, velocity.x(), velocity.y(), velocity.z());
  ++m_nodesVisited;
}

void ContactWetting::transferState(StateArchive& archive) {
  for (WetBody& wet : m_parameters.wetBodies) archive.value(wet.water);
  archive.value(m_nodesVisited);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
