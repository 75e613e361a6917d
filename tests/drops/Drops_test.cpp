// SPDX-License-Identifier: Zlib
// Drops in their world: what they refuse, how long they live, what they save, and that they allocate nothing.

#include "tests/drops/DropsScene.h"
#include "tests/support/Rejection.h"
#include "tests/support/RigidBody.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <sstream>

namespace wetcloth_test::drops_test {
namespace {

using namespace drops_scene;
using wetcloth::Drops;
using wetcloth::Glass;
using wetcloth::Pour;

template <class Change>
std::string refusalOf(Change change) {
  Drops::Parameters parameters;
  change(parameters);
  return rejection([&] { DropsScene scene(parameters); });
}

template <class Change>
std::string refusalOfPour(Change change) {
  DropsScene scene;
  Pour pour;
  change(pour);
  return rejection([&] { scene.drops.add(pour); });
}

bool begins(const std::string& text, const std::string& with) { return text.compare(0, with.size(), with) == 0; }

TEST(DropsBadInput, NamesTheField) {
  for (const double bad : {-1.0, 0.0, kNaN, kInfinity}) {
    EXPECT_TRUE(begins(refusalOf([&](auto& p) { p.dropMass = bad; }), "Drops.dropMass = "));
    EXPECT_TRUE(begins(refusalOf([&](auto& p) { p.longestFlight = bad; }), "Drops.longestFlight = "));
    EXPECT_TRUE(begins(refusalOf([&](auto& p) { p.filmCell = bad; }), "Drops.filmCell = "));
    EXPECT_TRUE(begins(refusalOf([&](auto& p) { p.air.waterDensity = bad; }), "Drops.air.waterDensity = "));
    EXPECT_TRUE(begins(refusalOf([&](auto& p) { p.air.surfaceTension = bad; }), "Drops.air.surfaceTension = "));
  }
  for (const double bad : {-1.0, kNaN, kInfinity}) {
    EXPECT_TRUE(begins(refusalOf([&](auto& p) { p.filmDensity = bad; }), "Drops.filmDensity = "));
    EXPECT_TRUE(begins(refusalOf([&](auto& p) { p.air.density = bad; }), "Drops.air.density = "));
    EXPECT_TRUE(begins(refusalOf([&](auto& p) { p.air.viscosity = bad; }), "Drops.air.viscosity = "));
  }
  for (const int bad : {0, -1, 2000000000}) {
    EXPECT_TRUE(begins(refusalOf([&](auto& p) { p.mostDrops = bad; }), "Drops.mostDrops = ")) << bad;
  }
  EXPECT_TRUE(begins(refusalOf([](auto& p) { p.wind = btVector3(0, btScalar(kNaN), 0); }), "Drops.wind"));
  EXPECT_TRUE(begins(refusalOf([](auto& p) { p.surface = wetcloth::WaterSurface{btVector3(0, 0, 0)}; }),
                     "Drops.surface.normal"));
  EXPECT_EQ(refusalOf([](auto&) {}), "");
}

TEST(DropsBadInput, NamesTheFieldOfASpout) {
  for (const double bad : {-1.0, kNaN, kInfinity}) {
    EXPECT_TRUE(begins(refusalOfPour([&](auto& p) { p.flow = bad; }), "pours[0].flow = "));
    EXPECT_TRUE(begins(refusalOfPour([&](auto& p) { p.dropDiameter = bad; }), "pours[0].dropDiameter = "));
    EXPECT_TRUE(begins(refusalOfPour([&](auto& p) { p.mouthRadius = bad; }), "pours[0].mouthRadius = "));
    EXPECT_TRUE(begins(refusalOfPour([&](auto& p) { p.halfAngle = bad; }), "pours[0].halfAngle = "));
    EXPECT_TRUE(
        begins(refusalOfPour([&](auto& p) { p.position = btVector3(0, btScalar(kNaN), 0); }), "pours[0].position.y"));
  }
  EXPECT_EQ(refusalOfPour([](auto& p) { p.halfAngle = 1.57079; }), "");
  EXPECT_TRUE(begins(refusalOfPour([](auto& p) { p.halfAngle = 1.5708; }), "pours[0].halfAngle = "));
  EXPECT_TRUE(begins(refusalOfPour([](auto& p) { p.velocity.setX(btScalar(kInfinity)); }), "pours[0].velocity.x"));
  EXPECT_TRUE(begins(refusalOfPour([](auto& p) { p.start = kNaN; }), "pours[0].start = "));
  EXPECT_TRUE(begins(refusalOfPour([](auto& p) { p.stop = -1; }), "pours[0].stop = "));
  EXPECT_EQ(refusalOfPour([](auto&) {}), "");

  DropsScene scene;
  const auto refusalOfGlass = [&](auto change) {
    Glass glass;
    change(glass);
    return rejection([&] { scene.drops.add(glass); });
  };
  EXPECT_TRUE(begins(refusalOfGlass([](auto& g) { g.radius = 0; }), "glasses[0].radius = "));
  EXPECT_TRUE(begins(refusalOfGlass([](auto& g) { g.height = kNaN; }), "glasses[0].height = "));
  EXPECT_TRUE(begins(refusalOfGlass([](auto& g) { g.water = 0.5; }), "glasses[0].water = "));
  EXPECT_TRUE(begins(refusalOfGlass([](auto& g) { g.timeConstant = 0; }), "glasses[0].timeConstant = "));
  EXPECT_THROW(scene.drops.setPour(0, Pour()), std::out_of_range);
}

TEST(DropsBadInput, ASetterThatThrowsChangesNothing) {
  DropsScene scene;
  Drops::Parameters parameters;
  parameters.mostDrops = 0;
  EXPECT_THROW(scene.drops.setParameters(parameters), std::invalid_argument);
  EXPECT_EQ(scene.drops.parameters().mostDrops, 10000);
}

TEST(DropsBadInput, OneToAWorld) {
  DropsScene scene;
  EXPECT_NE(rejection([&] { Drops another(scene.scene().wet()); }), "");
}

TEST(DropsInTheirWorld, MayEndBeforeItOrAfter) {
  ClothScene scene(WorldKind::softRigid, kEarthGravity, pinned(3), wetcloth::Fabric::cotton(), wetcloth::Hook::manual);
  auto drops = std::make_unique<Drops>(scene.wet());
  drops.reset();
  EXPECT_FALSE(scene.cloth().water().keepsShed());
  Drops again(scene.wet());
  scene.wet().detach();
  EXPECT_EQ(again.world(), nullptr);
  EXPECT_EQ(again.ledger().imbalance(), 0);
}

TEST(DropsInTheirWorld, AClothThatGoesTakesItsWaterAlong) {
  DropsScene scene;
  scene.cloth().setSaturation(1);
  scene.cloth().add<wetcloth::Dripping>();
  scene.step(100);
  const double initial = scene.drops.ledger().initial;
  scene.scene().wet().remove(scene.cloth().body());
  const wetcloth::WorldLedger ledger = scene.drops.ledger();
  EXPECT_EQ(ledger.held, 0);
  EXPECT_NEAR(ledger.initial, initial, kLedger * initial);
  EXPECT_NEAR(ledger.imbalance(), 0, kLedger * initial);
}

TEST(DropsInTheirWorld, WithoutDropsNothingIsKept) {
  ClothScene scene(WorldKind::softRigid, kEarthGravity, pinned(3), wetcloth::Fabric::cotton(), wetcloth::Hook::manual);
  EXPECT_FALSE(scene.cloth().water().keepsShed());
  EXPECT_EQ(scene.wet().films(), nullptr);
}

// A wet cloth over a dry one over a box, a shower that moves, a glass that tips.
class Busy {
 public:
  explicit Busy(WorldKind kind) : m_bullet(kind), m_table(m_bullet, box(1, 0.1, 1), 0, btVector3(0, -1, 0)) {
    wetcloth::ClothPatch upper = levelPatch(6, 0.4);
    upper.origin.setY(btScalar(0.5));
    upper.pinnedCorners = {wetcloth::ClothPatch::Corner::bottomLeft, wetcloth::ClothPatch::Corner::topRight};
    wetcloth::ClothPatch lower = levelPatch(6, 0.6);
    lower.pinnedEdges = {wetcloth::ClothPatch::Edge::top, wetcloth::ClothPatch::Edge::bottom};
    for (const auto& patch : {upper, lower}) {
      m_bodies.push_back(patch.build(m_bullet.info()));
      m_bullet.add(*m_bodies.back());
      if (m_bullet.isDeformable()) m_bullet.addForce(*m_bodies.back(), bulletSprings(20, 0.05));
    }
    m_wet = std::make_unique<wetcloth::WetClothWorld>(m_bullet.world());
    m_wet->setLog(nullptr);
    m_drops = std::make_unique<Drops>(*m_wet);
    for (const auto& body : m_bodies) m_wet->add(*body).add<wetcloth::Dripping>();
    m_wet->cloths()[0].setSaturation(1);
    Pour pour;
    pour.mouthRadius = 0.05;
    pour.halfAngle = 0.2;
    pour.flow = 0.02;
    pour.move = [](Pour& spout, double time) { spout.position = btVector3(btScalar(0.3 * std::sin(5 * time)), 1, 0); };
    m_drops->add(pour);
    Glass glass;
    glass.pose = [](double time) {
      return btTransform(btQuaternion(btVector3(0, 0, 1), btScalar(std::min(1.5, 4 * time))),
                         btVector3(0, btScalar(0.8), 0));
    };
    m_drops->add(glass);
  }
  ~Busy() {
    m_drops.reset();
    m_wet.reset();
    for (const auto& body : m_bodies) m_bullet.remove(*body);
  }

  void step(int count) { m_bullet.step(count); }
  Drops& drops() { return *m_drops; }
  std::string saved() {
    std::ostringstream stream;
    m_wet->save(stream);
    return stream.str();
  }
  void restore(const std::string& state) {
    std::istringstream stream(state);
    m_wet->restore(stream);
  }

 private:
  BulletWorld m_bullet;
  RigidBody m_table;
  std::vector<std::unique_ptr<btSoftBody>> m_bodies;
  std::unique_ptr<wetcloth::WetClothWorld> m_wet;
  std::unique_ptr<Drops> m_drops;
};

TEST_IN_EVERY_WORLD(DropsInTheirWorld, TheLedgerClosesAtEveryStep) {
  Busy busy(GetParam());
  for (int i = 0; i < 240; ++i) {
    busy.step(1);
    const wetcloth::WorldLedger ledger = busy.drops().ledger();
    ASSERT_NEAR(ledger.imbalance(), 0, kLedger * (ledger.initial + ledger.brought)) << i;
    ASSERT_GE(ledger.inFlight, 0);
  }
  EXPECT_GT(busy.drops().ledger().films, 0);
  EXPECT_GT(busy.drops().landedOnCloth(), 100);
}

TEST_IN_EVERY_WORLD(DropsInTheirWorld, GoOnAfterARestoreAsIfNothingHadBeen) {
  for (const int before : {0, 1, 60}) {
    Busy whole(GetParam());
    whole.step(before);
    const std::string middle = whole.saved();
    whole.step(60);
    Busy restored(GetParam());
    restored.restore(middle);
    EXPECT_TRUE(restored.saved() == middle) << before;
    restored.step(60);
    EXPECT_TRUE(restored.saved() == whole.saved()) << before;
    restored.restore(middle);  // into one that has gone on
    restored.step(60);
    EXPECT_TRUE(restored.saved() == whole.saved()) << before;
  }
}

TEST(DropsInTheirWorld, AStateWithDropsIsRefusedWithoutThem) {
  Busy busy(WorldKind::softRigid);
  busy.step(10);
  const std::string state = busy.saved();
  ClothScene scene(WorldKind::softRigid, kEarthGravity, pinned(3));
  std::istringstream stream(state);
  EXPECT_THROW(scene.wet().restore(stream), wetcloth::StateError);
}

TEST(DropsInTheirWorld, SpheresAreWhereDropsWillBe) {
  DropsScene scene;
  scene.drops.add(oneDrop(btVector3(3, 2, 0), btVector3(1, 0, 0)));
  scene.step(10);
  float sphere[4];
  scene.drops.writeSpheres(sphere, 9 * kSubstep + 0.5);
  EXPECT_NEAR(double(sphere[0]), double(scene.drops[0].position.x()) + 0.5 * double(scene.drops[0].velocity.x()), 1e-6);
  EXPECT_NEAR(double(sphere[3]), 2e-3, 1e-8);
}

TEST(DropsInTheirWorld, ACallbackThatThrowsIsAskedNoMore) {
  Drops::Parameters parameters;
  int asked = 0;
  parameters.onLanding = [&](const wetcloth::Landing&) {
    ++asked;
    throw std::runtime_error("spilt");
  };
  DropsScene scene(parameters);
  std::string said;
  scene.scene().wet().setLog([&](const std::string& message) { said += message; });
  Pour pour;
  pour.position = btVector3(0, btScalar(0.3), 0);
  scene.drops.add(pour);
  scene.step(240);
  EXPECT_EQ(asked, 1);
  EXPECT_NE(said.find("spilt"), std::string::npos);
  EXPECT_GT(scene.drops.landedOnCloth(), 100);
}

TEST(DropsInTheirWorld, WhateverIsThrownDoesNotTravelThroughTheStep) {
  Drops::Parameters parameters;
  parameters.onLanding = [](const wetcloth::Landing&) { throw 3; };
  DropsScene scene(parameters);
  std::string said;
  scene.scene().wet().setLog([&](const std::string& message) {
    said += message + "\n";
    throw std::runtime_error("the log is full");
  });
  Pour pour;
  pour.position = btVector3(0, btScalar(0.3), 0);
  scene.drops.add(pour);
  pour.move = [](Pour&, double time) {
    if (time > 0.3) throw 7;
  };
  scene.drops.add(pour);
  EXPECT_NO_THROW(scene.step(120));
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 2) << said;
  EXPECT_GT(scene.drops.landedOnCloth(), 100);
}

// What is in the air falls on, and the spout that gave it goes on.
TEST(DropsInTheirWorld, AWindThatThrowsIsStillAndNoSpoutIsBlamed) {
  Drops::Parameters parameters;
  parameters.wind = [](const btVector3&, double time) -> btVector3 {
    if (time > 0.3) throw std::runtime_error("no forecast");
    return btVector3(0, 0, 0);
  };
  DropsScene scene(parameters);
  std::string said;
  scene.scene().wet().setLog([&](const std::string& message) { said += message + "\n"; });
  Pour pour;
  pour.position = btVector3(0, btScalar(0.3), 0);
  scene.drops.add(pour);
  scene.step(60);
  const long long before = scene.drops.landedOnCloth();
  EXPECT_NO_THROW(scene.step(60));
  EXPECT_NE(said.find("no forecast"), std::string::npos) << said;
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
  EXPECT_GT(scene.drops.landedOnCloth(), before + 50);
}

}  // namespace
}  // namespace wetcloth_test::drops_test
