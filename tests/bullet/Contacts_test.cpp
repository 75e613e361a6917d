// SPDX-License-Identifier: Zlib
// The reader of Bullet's contact lists: what it tells of a contact, and what it passes over.

#include "bullet_wetcloth/bullet/Contacts.h"
#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/CallEffect.h"
#include "tests/support/ClothScene.h"
#include "tests/support/ContactScene.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/RigidBody.h"
#include "tests/support/SoftBodies.h"

namespace wetcloth_test::contacts_test {
namespace {

using wetcloth::FaceContact;
using wetcloth::FaceContacts;
using wetcloth::RigidContact;
using wetcloth::RigidContacts;

RigidContacts contactsOf(wetcloth::WetCloth& cloth) {
  return RigidContacts(cloth.body(), cloth.world().world(), cloth.isInDeformableWorld());
}

TEST_IN_EVERY_WORLD(ContactsInWorld, ARigidContactIsToldAlikeInEveryWorld) {
  ClothScene scene(GetParam(), {0, 0, 0}, Lying().builder(GetParam()));
  RigidBody floor(scene.bullet(), box(5, 0.5, 5), 0, {0, -0.5, 0});
  std::array<int, 16> found = {};
  addCall(
      scene.cloth(),
      [&](wetcloth::WetCloth& cloth, const wetcloth::Step&) {
        contactsOf(cloth).visit([&](const RigidContact& contact) {
          EXPECT_EQ(contact.point.count, 1);
          ++found[std::size_t(contact.point.nodes[0])];
          EXPECT_EQ(contact.object, &floor.body());
          EXPECT_NEAR(double(contact.normal.y()), 1, 1e-6);
          EXPECT_NEAR(contact.gap, -0.1 * kMargin, 1e-6);  // the floor is sampled on a grid, in btScalar
          EXPECT_EQ(contact.positionBased == nullptr, cloth.isInDeformableWorld());
          EXPECT_EQ(contact.deformable != nullptr, cloth.isInDeformableWorld());
        });
      },
      wetcloth::Stage::contact);
  scene.step(1);
  for (const int times : found) EXPECT_EQ(times, 1);
}

TEST_IN_EVERY_WORLD(ContactsInWorld, WhatHasLeftTheWorldIsPassedOver) {
  ClothScene scene(GetParam(), kEarthGravity, Lying().builder(GetParam()));
  const auto count = [&] {
    int contacts = 0;
    contactsOf(scene.cloth()).visit([&](const RigidContact&) { ++contacts; });
    return contacts;
  };
  {
    RigidBody floor(scene.bullet(), box(5, 0.5, 5), 0, {0, -0.5, 0});
    scene.step(1);
    EXPECT_EQ(count(), 16);
  }
  EXPECT_EQ(count(), 0);
}

// Bullet's lists keep the addresses of nodes that moved when the body was cut.
TEST_IN_EVERY_WORLD(ContactsInWorld, NodesThatMovedInMemoryArePassedOver) {
  ClothScene scene(GetParam(), kEarthGravity, Lying().builder(GetParam()));
  RigidBody floor(scene.bullet(), box(5, 0.5, 5), 0, {0, -0.5, 0});
  scene.step(1);
  btSoftBody& body = scene.body();
  const btSoftBody::Node* const before = &body.m_nodes[0];
  ASSERT_TRUE(body.cutLink(body.m_faces[0].m_n[0], body.m_faces[0].m_n[1], btScalar(0.5)));
  ASSERT_NE(before, &body.m_nodes[0]);
  contactsOf(scene.cloth()).visit([&](const RigidContact& contact) {
    EXPECT_LT(contact.point.nodes[0], body.m_nodes.size());
    EXPECT_GE(contact.point.nodes[0], 0);
  });
}

TEST_IN_WORLDS_WITH_FACE_CONTACTS(ContactsInWorld, AContactWithATriangleHasWeightsThatSumToOne) {
  ClothScene scene(GetParam(), kEarthGravity, Lying().builder(GetParam()));
  RigidBody floor(scene.bullet(), box(5, 0.5, 5), 0, {0, -0.5, 0});
  Lying above;
  above.height = 2.8 * kMargin;
  above.side = 0.25;  // no node over another
  const auto upper = above.builder(GetParam())(scene.bullet().info());
  scene.bullet().add(*upper);
  int found = 0;
  for (int step = 0; step < 60; ++step) {
    scene.step(1);
    FaceContacts(*upper, scene.body(), scene.bullet().isDeformable()).visit([&](const FaceContact& contact) {
      ++found;
      double sum = 0;
      btVector3 place(0, 0, 0);
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_GE(contact.point.weights[k], 0);
        sum += contact.point.weights[k];
        place += scene.node(contact.point.nodes[k]).m_x * btScalar(contact.point.weights[k]);
      }
      EXPECT_NEAR(sum, 1, 1e-12);
      // Under the node, within the margins of both and what they moved since.
      EXPECT_LT(double((upper->m_nodes[contact.node].m_x - place).length()), 3 * kMargin);
      EXPECT_GT(double(contact.normal.y()), 0.9);
    });
    FaceContacts(*upper, *upper, scene.bullet().isDeformable()).visit([&](const FaceContact&) {
      ADD_FAILURE() << "a contact of others";
    });
  }
  EXPECT_GT(found, 0);
  scene.bullet().remove(*upper);
}

TEST(ContactsOfTriangles, AreToldWithTheirFace) {
  using Flags = btSoftBody::fCollision;
  ClothScene scene(WorldKind::deformable, kEarthGravity, Lying().builder(WorldKind::deformable));
  scene.body().m_cfg.collisions = Flags::SDF_RD | Flags::SDF_RDF;
  RigidBody floor(scene.bullet(), box(5, 0.5, 5), 0, {0, -0.5, 0});
  scene.step(1);
  int found = 0;
  contactsOf(scene.cloth()).visit([&](const RigidContact& contact) {
    ++found;
    EXPECT_EQ(contact.point.count, 3);
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(scene.body().m_faces[contact.face].m_n[k], &scene.node(contact.point.nodes[std::size_t(k)]));
    }
  });
  EXPECT_EQ(found, 18);
}

}  // namespace
}  // namespace wetcloth_test::contacts_test
