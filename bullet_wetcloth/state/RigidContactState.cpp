// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/state/RigidContactState.h"

#include "bullet_wetcloth/state/ManifoldPlace.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

struct Contact {
  ManifoldPlace place;
  std::vector<btManifoldPoint> points;
};

// Bullet's predictions belong to no pair. The next step begins by giving them up, and puts the last manifold into the
// place of each: this is the order that it leaves.
template <class Places>
void giveUpPredictions(std::vector<btPersistentManifold*>& manifolds, const Places& places) {
  std::vector<btPersistentManifold*> predictions;
  std::copy_if(manifolds.begin(), manifolds.end(), std::back_inserter(predictions),
               [&](const btPersistentManifold* manifold) { return places.count(manifold) == 0; });
  for (btPersistentManifold* const prediction : predictions) {
    *std::find(manifolds.begin(), manifolds.end(), prediction) = manifolds.back();
    manifolds.pop_back();
  }
}

std::vector<Contact> contactsOf(btCollisionWorld& world) {
  const auto places = manifoldPlaces(world);
  btPersistentManifold** const begin = world.getDispatcher()->getInternalManifoldPointer();
  std::vector<btPersistentManifold*> manifolds(begin, begin + world.getDispatcher()->getNumManifolds());
  giveUpPredictions(manifolds, places);
  std::vector<Contact> contacts;
  for (const btPersistentManifold* const manifold : manifolds) {
    contacts.push_back({places.at(manifold), {}});
    for (int i = 0; i < manifold->getNumContacts(); ++i) contacts.back().points.push_back(manifold->getContactPoint(i));
  }
  return contacts;
}

int transferObject(StateArchive& archive, int index, const btCollisionObjectArray& objects) {
  index = archive.place(index, objects.size(), "object of a contact");
  if (objects[index]->getInternalType() == btCollisionObject::CO_SOFT_BODY) {
    archive.fail("a soft body has the contact of a rigid one");
  }
  return index;
}

void transferPoint(StateArchive& archive, btManifoldPoint& point) {
  archive.value(point.m_localPointA, point.m_localPointB, point.m_positionWorldOnA, point.m_positionWorldOnB);
  archive.value(point.m_normalWorldOnB, point.m_lateralFrictionDir1, point.m_lateralFrictionDir2, point.m_distance1);
  archive.value(point.m_combinedFriction, point.m_combinedRollingFriction, point.m_combinedSpinningFriction);
  archive.value(point.m_combinedRestitution, point.m_partId0, point.m_partId1, point.m_index0, point.m_index1);
  archive.value(point.m_contactPointFlags, point.m_appliedImpulse, point.m_prevRHS, point.m_appliedImpulseLateral1);
  archive.value(point.m_appliedImpulseLateral2, point.m_contactMotion1, point.m_contactMotion2, point.m_contactCFM);
  archive.value(point.m_contactERP, point.m_frictionCFM, point.m_lifeTime);
}

void transferContact(StateArchive& archive, Contact& contact, const btCollisionObjectArray& objects) {
  constexpr int kAnyNumber = std::numeric_limits<int>::max();
  ManifoldPlace& place = contact.place;
  place.first = transferObject(archive, place.first, objects);
  place.second = transferObject(archive, place.second, objects);
  place.part = archive.index(place.part, kAnyNumber, "part of a shape");
  place.number = archive.place(place.number, kAnyNumber, "manifold");
  const std::size_t size = archive.count(contact.points.size());
  if (size > MANIFOLD_CACHE_SIZE) archive.fail("a contact of " + std::to_string(size) + " points");
  contact.points.resize(size);
  for (btManifoldPoint& point : contact.points) transferPoint(archive, point);
}

void setPoints(btPersistentManifold& manifold, const std::vector<btManifoldPoint>& points) {
  manifold.clearManifold();
  manifold.setNumContacts(static_cast<int>(points.size()));
  for (int i = 0; i < manifold.getNumContacts(); ++i) manifold.getContactPoint(i) = points[static_cast<std::size_t>(i)];
}

void moveTo(int place, btPersistentManifold& manifold, btDispatcher& dispatcher) {
  btPersistentManifold** const all = dispatcher.getInternalManifoldPointer();
  const int from = manifold.m_index1a;
  std::swap(all[place], all[from]);
  all[place]->m_index1a = place;
  all[from]->m_index1a = from;
}

void restore(btCollisionWorld& world, const std::vector<Contact>& contacts) {
  removeManifolds(world);
  int next = 0;
  for (const Contact& contact : contacts) {
    btPersistentManifold* const manifold = manifoldAt(world, contact.place);
    if (!manifold || manifold->m_index1a < next) continue;  // not there, or told of twice
    setPoints(*manifold, contact.points);
    moveTo(next++, *manifold, *world.getDispatcher());
  }
}

}  // namespace

void transferRigidContacts(StateArchive& archive, btCollisionWorld& world) {
  std::vector<Contact> contacts;
  if (archive.isSaving()) contacts = contactsOf(world);
  contacts.resize(archive.count(contacts.size()));
  for (Contact& contact : contacts) transferContact(archive, contact, world.getCollisionObjectArray());
  if (archive.isRestoring()) restore(world, contacts);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
