// SPDX-License-Identifier: Zlib
// A body is deleted without a word to us, and an allocator gives its address to the next: that is a dry one.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Materials.h"
#include "tests/support/Patches.h"

#include <gtest/gtest.h>

#include <new>
#include <stdexcept>

namespace wetcloth_test::another_body_at_the_address_test {

namespace {

// Two bodies, one after the other, at one address.
class AtOneAddress {
 public:
  AtOneAddress(BulletWorld& bullet, int n) : m_bullet(bullet), m_place(btAlignedAlloc(sizeof(btSoftBody), 16)) {
    make(n);
  }
  ~AtOneAddress() {
    unmake();
    btAlignedFree(m_place);
  }
  AtOneAddress(const AtOneAddress&) = delete;
  AtOneAddress& operator=(const AtOneAddress&) = delete;

  void replace(int n) {
    unmake();
    make(n);
  }
  btSoftBody& body() { return *m_body; }

 private:
  void make(int n) {
    const std::unique_ptr<btSoftBody> pattern = squarePatch(n).build(m_bullet.info());
    std::vector<btVector3> places;
    std::vector<btScalar> masses;
    for (int i = 0; i < pattern->m_nodes.size(); ++i) {
      places.push_back(pattern->m_nodes[i].m_x);
      masses.push_back(pattern->getMass(i));
    }
    m_body = new (m_place) btSoftBody(&m_bullet.info(), int(places.size()), places.data(), masses.data());
    const auto numberOf = [&](const btSoftBody::Node* node) { return int(node - &pattern->m_nodes[0]); };
    for (int k = 0; k < pattern->m_links.size(); ++k) {
      m_body->appendLink(numberOf(pattern->m_links[k].m_n[0]), numberOf(pattern->m_links[k].m_n[1]));
    }
    for (int f = 0; f < pattern->m_faces.size(); ++f) {
      btSoftBody::Node* const* corners = pattern->m_faces[f].m_n;
      m_body->appendFace(numberOf(corners[0]), numberOf(corners[1]), numberOf(corners[2]));
    }
    m_bullet.add(*m_body);
  }
  void unmake() {
    m_bullet.world().removeCollisionObject(m_body);
    m_body->~btSoftBody();
  }

  BulletWorld& m_bullet;
  void* m_place;
  btSoftBody* m_body = nullptr;
};

class AnotherBody {
 protected:
  BulletWorld bullet{GetParam()};
};

TEST_F_IN_EVERY_WORLD(AnotherBody, AddedAgainIsDry) {
  for (const int n : {5, 4, 6}) {
    AtOneAddress place(bullet, 5);
    wetcloth::WetClothWorld wet(bullet.world());
    wet.setLog({});
    wetcloth::WetCloth& first = wet.add(place.body());
    first.add<wetcloth::HookeSprings>(springsOf(200, 5));
    first.setSaturation(1);
    bullet.step(3);
    place.replace(n);
    wetcloth::WetCloth& second = wet.add(place.body());
    EXPECT_EQ(second.nodeCount(), n * n);
    EXPECT_EQ(second.ledger().held, 0);
    EXPECT_TRUE(second.effects().empty());
    EXPECT_EQ(wet.cloths().size(), 1u);
    bullet.step(3);
    EXPECT_NEAR(second.totalMass(), double(place.body().getTotalMass()), 1e-5);
    wet.remove(place.body());
  }
}

TEST_F_IN_EVERY_WORLD(AnotherBody, NotAddedAgainIsLeftAlone) {
  AtOneAddress place(bullet, 5);
  std::vector<std::string> messages;
  wetcloth::WetClothWorld wet(bullet.world());
  wet.setLog([&](const std::string& message) { messages.push_back(message); });
  wetcloth::WetCloth& first = wet.add(place.body());
  first.add<wetcloth::Absorption>();
  first.setSaturation(0.5);
  bullet.step(3);
  place.replace(6);
  const btScalar dry = place.body().getTotalMass();
  bullet.step(10);
  EXPECT_EQ(place.body().getTotalMass(), dry);
  EXPECT_EQ(messages.size(), 1u);
  EXPECT_THROW(first.add<wetcloth::Wind>(), std::invalid_argument);
  EXPECT_THROW(first.setSaturation(1), std::invalid_argument);
  EXPECT_EQ(first.nodeCount(), 25);
  wet.remove(place.body());
  EXPECT_EQ(place.body().getTotalMass(), dry);
}

}  // namespace
}  // namespace wetcloth_test::another_body_at_the_address_test
