// SPDX-License-Identifier: Zlib
// Water from wet rigid bodies: the law, the film's balance, its momentum, and which nodes get it.

#include "bullet_wetcloth/bullet/Contacts.h"
#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/CallEffect.h"
#include "tests/support/ClothScene.h"
#include "tests/support/ContactScene.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Measures.h"
#include "tests/support/Rejection.h"
#include "tests/support/RigidBody.h"

#include <algorithm>

namespace wetcloth_test::contact_wetting_test {
namespace {

using wetcloth::ContactWetting;
using wetcloth::equalisingFlow;
using wetcloth::filmUptake;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// --- free functions -------------------------------------------------------------------------------------------------

TEST(FilmUptake, FollowsTheExponential) {
  EXPECT_NEAR(filmUptake(0.2, 1, 0.5, kInfinite), 0.8 * (1 - std::exp(-0.5)), 1e-16);
  EXPECT_EQ(filmUptake(0.2, 1, 0.5, 0.1), 0.1) << "no more than there is";
  EXPECT_EQ(filmUptake(0.2, 1, 0, kInfinite), 0);
  EXPECT_EQ(filmUptake(1, 1, 5, kInfinite), 0);
  EXPECT_EQ(filmUptake(1.5, 1, 5, kInfinite), 0) << "over-full";
  EXPECT_EQ(filmUptake(0.25, 1, 1e3, kInfinite), 0.75);
  EXPECT_NEAR(filmUptake(0, 1, 1e-12, kInfinite), 1e-12, 1e-24);
}

TEST(EqualisingFlow, FollowsTheExponentialOfThePair) {
  // Two of capacity 1 and 3: they meet at the mean saturation, which half of the flow's end brings.
  const double all = 0.8 / (1 + 1.0 / 3);
  EXPECT_NEAR(equalisingFlow(0.8, 1, 1.0 / 3, 1e3), all, 1e-15);
  EXPECT_NEAR(equalisingFlow(0.8, 1, 1.0 / 3, 0.3), all * (1 - std::exp(-0.4)), 1e-15);
  EXPECT_EQ(equalisingFlow(-0.8, 1, 1.0 / 3, 0.3), -equalisingFlow(0.8, 1.0 / 3, 1, 0.3)) << "either way alike";
  EXPECT_EQ(equalisingFlow(0, 1, 1, 1), 0);
  // Two half steps are one step.
  const double first = equalisingFlow(0.8, 1, 1.0 / 3, 0.15);
  const double second = equalisingFlow(0.8 - first * (1 + 1.0 / 3), 1, 1.0 / 3, 0.15);
  EXPECT_NEAR(first + second, equalisingFlow(0.8, 1, 1.0 / 3, 0.3), 1e-15);
}

// --- on a wet floor
// ---------------------------------------------------------------------------------------------------

/// A dry cloth that lies on a box; the box's top is at 0 and reaches to x = halfX.
class OnFloor {
 public:
  explicit OnFloor(WorldKind kind, double halfX = 5, int flags = 0)
      : scene(kind, kEarthGravity,
              [=](btSoftBodyWorldInfo& info) {
                auto body = Lying().builder(kind)(info);
                if (flags != 0) body->m_cfg.collisions = flags;
                return body;
              }),
        floor(scene.bullet(), box(5, 0.5, 5), 0, {btScalar(halfX - 5), -0.5, 0}) {
    scene.addBulletSpringsForStep();
  }

  ContactWetting& wet(double film, double rate = 0.05) {
    ContactWetting::Parameters parameters;
    parameters.wetBodies = {{&floor.body(), film}};
    parameters.rate = rate;
    parameters.cloths = false;
    return scene.cloth().add<ContactWetting>(parameters);
  }
  double held() { return scene.cloth().ledger().held; }
  double capacity() { return scene.cloth().water().totalCapacity(); }

  ClothScene scene;
  RigidBody floor;
};

TEST_IN_EVERY_WORLD(ContactWettingInWorld, ANodeFillsWhileItTouches) {
  OnFloor cloth(GetParam());
  cloth.wet(kInfinite);
  std::array<int, 16> touched = {};  // steps in which Bullet had listed the node; it rests on the margin, in or out
  addCall(
      cloth.scene.cloth(),
      [&](wetcloth::WetCloth& wetCloth, const wetcloth::Step&) {
        wetcloth::RigidContacts(wetCloth.body(), wetCloth.world().world(), wetCloth.isInDeformableWorld())
            .visit([&](const wetcloth::RigidContact& contact) { ++touched[std::size_t(contact.point.nodes[0])]; });
      },
      wetcloth::Stage::sources);
  cloth.scene.step(240);
  for (int i = 0; i < 16; ++i) {
    EXPECT_GT(touched[std::size_t(i)], 20);
    // The area's share in the capacity, 0.84 x 0.150 kg/m^2, is the same for each node; masses are rounded to btScalar.
    const double filled = 1 - std::exp(-0.05 * touched[std::size_t(i)] * kSubstep / (0.84 * 0.150));
    EXPECT_NEAR(cloth.scene.cloth().saturation(i), filled, 1e-6) << i;
  }
}

TEST_IN_EVERY_WORLD(ContactWettingInWorld, WhatTheFilmLosesIsInTheCloth) {
  for (const double share : {0.3, 3.0}) {
    OnFloor cloth(GetParam());
    const double film = share * cloth.capacity();
    ContactWetting& wetting = cloth.wet(film, 1);
    for (int i = 0; i < 240; ++i) {
      cloth.scene.step(1);
      const double left = wetting.film(cloth.floor.body());
      ASSERT_GE(left, 0);
      ASSERT_NEAR(film - left, cloth.scene.cloth().ledger().absorbed, 1e-14 * film);
      ASSERT_LE(std::fabs(cloth.scene.cloth().ledger().imbalance()), 1e-15 * film);
    }
    EXPECT_NEAR(cloth.held(), std::min(film, cloth.capacity()), 0.01 * film);
  }
}

TEST_IN_EVERY_WORLD(ContactWettingInWorld, IdlesWhenFull) {
  OnFloor cloth(GetParam());
  ContactWetting& wetting = cloth.wet(kInfinite, 10);
  cloth.scene.step(240);
  for (int i = 0; i < 16; ++i) EXPECT_EQ(cloth.scene.cloth().saturation(i), 1);
  const long long visited = wetting.nodesVisited();
  EXPECT_GT(visited, 0);
  cloth.scene.step(60);
  EXPECT_EQ(wetting.nodesVisited(), visited);
}

TEST_IN_EVERY_WORLD(ContactWettingInWorld, OnlyWhatTouchesGetsWet) {
  OnFloor cloth(GetParam(), 0);
  // It would slide off the edge.
  for (int i = 0; i < 16; ++i) cloth.scene.node(i).m_im = 0;
  cloth.scene.body().updateLinkConstants();
  RigidBody mover(cloth.scene.bullet(), box(5, 0.5, 5), 1, {-5, btScalar(-0.5), 0});  // pinned nodes touch what moves
  mover.body().setGravity({0, 0, 0});
  ContactWetting& wetting = cloth.wet(kInfinite);
  wetting.setFilm(mover.body(), kInfinite);
  cloth.scene.step(5);
  for (int i = 0; i < 16; ++i) {
    const bool isOver = cloth.scene.node(i).m_x.x() < 0;
    if (isOver) {
      EXPECT_GT(cloth.scene.cloth().held(i), 0) << i;
    } else {
      EXPECT_EQ(cloth.scene.cloth().held(i), 0) << i;
    }
  }
}

TEST_IN_EVERY_WORLD(ContactWettingInWorld, ADryFloorChangesNothing) {
  OnFloor with(GetParam());
  OnFloor without(GetParam());
  ContactWetting& wetting = with.wet(0);
  with.scene.step(60);
  without.scene.step(60);
  EXPECT_EQ(wetting.nodesVisited(), 0);
  EXPECT_TRUE(sameBits(stateOf(with.scene.body()), stateOf(without.scene.body())));
}

TEST_IN_EVERY_WORLD(ContactWettingInWorld, WaterBringsTheVelocityOfItsBody) {
  OnFloor cloth(GetParam());
  cloth.scene.step(60);
  ContactWetting& wetting = cloth.wet(kInfinite, 1);
  cloth.floor.body().setLinearVelocity({2, 0, 0});
  const auto before = momentum(cloth.scene.body());
  cloth.scene.preTick(kSubstep);
  const double taken = cloth.held();
  ASSERT_GT(taken, 0);
  ASSERT_GT(wetting.nodesVisited(), 0);
  const auto after = momentum(cloth.scene.body());
  // Rounding of btScalar velocities; gravity is Bullet's and comes later.
  EXPECT_NEAR(after[0] - before[0], 2 * taken, (kIsDouble ? 1e-12 : 1e-5) * taken);
  EXPECT_NEAR(after[1] - before[1], 0, (kIsDouble ? 1e-12 : 1e-5) * taken);
}

TEST_IN_EVERY_WORLD(ContactWettingInWorld, NoStepIsTooLong) {
  OnFloor cloth(GetParam());
  cloth.scene.step(60);
  ContactWetting& wetting = cloth.wet(0.5 * cloth.capacity());
  for (const double dt : {1e-6, 1e-3, 1.0, 1e3}) {
    cloth.scene.preTick(dt);
    for (int i = 0; i < 16; ++i) {
      EXPECT_GE(cloth.scene.cloth().saturation(i), 0);
      EXPECT_LE(cloth.scene.cloth().saturation(i), 1);
    }
    EXPECT_GE(wetting.film(cloth.floor.body()), 0);
  }
}

TEST_IN_EVERY_WORLD(ContactWettingInWorld, ABodyThatLeftTheWorldGivesNothing) {
  ClothScene scene(GetParam(), kEarthGravity, Lying().builder(GetParam()));
  auto floor = std::make_unique<RigidBody>(scene.bullet(), box(5, 0.5, 5), 0, btVector3(0, -0.5, 0));
  ContactWetting::Parameters parameters;
  parameters.wetBodies = {{&floor->body()}};
  scene.cloth().add<ContactWetting>(parameters);
  scene.step(60);
  const double held = scene.cloth().ledger().held;
  EXPECT_GT(held, 0);
  floor.reset();
  scene.step(1);  // the sanitizers see to it that nobody looks at the floor
  EXPECT_EQ(scene.cloth().ledger().held, held);
}

// A body that sleeps keeps its old list of contacts: it soaks on, until what it lies on has been taken away.
TEST(ContactWettingAsleep, GoesOnWhileTheFloorIsThere) {
  using Flags = btSoftBody::fCollision;
  for (const int contacts : {Flags::SDF_RDN, Flags::SDF_RDF}) {
    OnFloor cloth(WorldKind::deformable, 5, Flags::SDF_RD | contacts);
    cloth.wet(kInfinite, 1e-4);
    for (int i = 0; i < 240 && !(cloth.held() > 0); ++i) cloth.scene.step(1);
    cloth.scene.body().forceActivationState(ISLAND_SLEEPING);
    const double before = cloth.held();
    ASSERT_GT(before, 0);
    cloth.scene.step(1);
    const double asleep = cloth.held();
    EXPECT_GT(asleep, before) << contacts;
    cloth.floor.body().getWorldTransform().setOrigin({0, -50, 0});
    cloth.scene.step(1);
    ASSERT_FALSE(cloth.scene.body().isActive());
    EXPECT_EQ(cloth.held(), asleep) << contacts;
  }
}

// A body whose triangles collide, not its nodes.
TEST(ContactWettingByTriangles, TakesFromTheFilmToo) {
  using Flags = btSoftBody::fCollision;
  for (const WorldKind kind : {WorldKind::deformable, WorldKind::deformableImplicit}) {
    OnFloor cloth(kind, 5, Flags::SDF_RD | Flags::SDF_RDF);
    const double film = 3 * cloth.capacity();
    ContactWetting& wetting = cloth.wet(film);
    cloth.scene.step(240);
    EXPECT_NEAR(film - wetting.film(cloth.floor.body()), cloth.held(), 1e-14 * film);
    // A triangle has one point of contact, often a corner; all of them together have the cloth's area.
    const double even = 1 - std::exp(-0.05 * 240 * kSubstep / (0.84 * 0.150));
    EXPECT_LT(cloth.scene.cloth().meanSaturation(), even);
    EXPECT_GT(cloth.scene.cloth().meanSaturation(), 0.5 * even);
  }
}

TEST(ContactWettingByTriangles, CountsOnceWhatNodesListToo) {
  using Flags = btSoftBody::fCollision;
  OnFloor nodes(WorldKind::deformable, 5, Flags::SDF_RD | Flags::SDF_RDN);
  OnFloor both(WorldKind::deformable, 5, Flags::SDF_RD | Flags::SDF_RDN | Flags::SDF_RDF);
  nodes.wet(kInfinite);
  both.wet(kInfinite);
  nodes.scene.step(60);
  both.scene.step(60);
  EXPECT_NEAR(both.held(), nodes.held(), 0.05 * nodes.held());
}

// --- bad input ------------------------------------------------------------------------------------------------------

TEST(ContactWettingParameters, AreChecked) {
  const btCollisionObject object;
  const auto why = [&](auto change) {
    ContactWetting::Parameters parameters;
    parameters.wetBodies = {{&object, 1}};
    change(parameters);
    return rejection([&] { ContactWetting wetting(parameters); });
  };
  EXPECT_EQ(why([](auto&) {}), "");
  EXPECT_EQ(why([](auto& p) { p.rate = -1; }), "ContactWetting.rate = -1: must be finite and >= 0");
  EXPECT_NE(why([](auto& p) { p.rate = kInfinite; }), "");
  EXPECT_NE(why([](auto& p) { p.rate = std::nan(""); }), "");
  EXPECT_EQ(why([](auto& p) { p.wetBodies[0].water = -2; }),
            "ContactWetting.wetBodies[0].water = -2: must be >= 0 (infinite is allowed)");
  EXPECT_NE(why([](auto& p) { p.wetBodies[0].water = std::nan(""); }), "");
  EXPECT_EQ(why([](auto& p) { p.wetBodies[0].body = nullptr; }), "ContactWetting.wetBodies[0].body: must not be null");
  EXPECT_EQ(why([](auto& p) { p.wetBodies.push_back(p.wetBodies[0]); }),
            "ContactWetting.wetBodies[1].body: is there twice");
  ContactWetting wetting({});
  EXPECT_THROW(adjust(wetting, [](auto& p) { p.rate = -1; }), std::invalid_argument);
  EXPECT_THROW(wetting.setFilm(object, -1), std::invalid_argument);
  EXPECT_EQ(wetting.film(object), 0);
  wetting.setFilm(object, 3);
  EXPECT_EQ(wetting.film(object), 3);
}

TEST(ContactWettingOnABody, SaysWhyItCannotWork) {
  using Flags = btSoftBody::fCollision;
  const btCollisionObject object;
  const auto why = [&](WorldKind kind, int flags, bool cloths, bool rigid) {
    ClothScene scene(kind, kEarthGravity, Lying().builder(kind));
    scene.body().m_cfg.collisions = flags;
    ContactWetting::Parameters parameters;
    parameters.cloths = cloths;
    if (rigid) parameters.wetBodies = {{&object}};
    return rejection([&] { scene.cloth().add<ContactWetting>(parameters); });
  };
  EXPECT_NE(why(WorldKind::softRigid, Flags::SDF_RS, true, true)
                .find("ContactWetting.cloths: m_cfg.collisions has not "
                      "fCollision::VF_SS"),
            std::string::npos);
  EXPECT_EQ(why(WorldKind::softRigid, Flags::SDF_RS, false, true), "");
  EXPECT_EQ(why(WorldKind::softRigid, Flags::VF_SS, true, false), "");
  EXPECT_NE(why(WorldKind::softRigid, Flags::VF_SS, true, true).find("SDF_RS"), std::string::npos);
  EXPECT_NE(why(WorldKind::softRigid, Flags::CL_SS, true, false).find("clusters"), std::string::npos);
  EXPECT_NE(why(WorldKind::deformable, Flags::SDF_RD, false, true).find("SDF_RDN"), std::string::npos);
  const std::string face = wetcloth::keepsFaceContacts() ? "VF_DD" : "Bullet 3.";
  EXPECT_NE(why(WorldKind::deformable, Flags::SDF_RD | Flags::SDF_RDN, true, true).find(face), std::string::npos);
  const int all = Flags::SDF_RD | Flags::SDF_RDN | Flags::VF_DD;
  EXPECT_EQ(why(WorldKind::deformable, all, true, true).empty(), wetcloth::keepsFaceContacts());
}

}  // namespace
}  // namespace wetcloth_test::contact_wetting_test
