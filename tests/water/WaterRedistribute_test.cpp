// SPDX-License-Identifier: Zlib
// Water that moves inside the cloth, between two nodes or many at once, conserves mass and momentum, also with water
// that arrives or leaves in the same step.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/CallEffect.h"
#include "tests/support/ExactPace.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Measures.h"
#include "tests/support/Patches.h"
#include "tests/support/UnevenWater.h"

#include <algorithm>
#include <array>
#include <limits>

namespace wetcloth_test::water_redistribute_test {

namespace {

using Vector = std::array<double, 3>;

// A velocity rounded to Bullet's scalar, times a handful of m/s.
constexpr double kTolerance = kIsDouble ? 1e-12 : 1e-5;

void scatterVelocities(btSoftBody& body) {
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    if (body.m_nodes[i].m_im == 0) continue;
    body.m_nodes[i].m_v = btVector3(btScalar(0.3 * (i % 5)), btScalar(-1 + 0.2 * (i % 7)), btScalar(0.1 * i));
    body.m_nodes[i].m_vn = body.m_nodes[i].m_v;
  }
}

/// 16 nodes with different water and velocities, and only our part of the step.
struct Moving {
  explicit Moving(WorldKind kind)
      : scene(kind, squarePatch(4)), wet(scene.world(), wetcloth::Hook::manual), cloth(exactly(wet.add(scene.body()))) {
    cloth.setHeld(unevenWater(cloth));
    scatterVelocities(scene.body());
  }
  void step(const std::function<void(wetcloth::Water&)>& happens) {
    wetcloth::Effect& effect = addCall(
        cloth, [&](wetcloth::WetCloth& c, const wetcloth::Step&) { happens(c.water()); }, wetcloth::Stage::transport);
    wet.preTick(btScalar(0.01));
    cloth.remove(effect);
  }
  /// Moves water with the velocity of the node that it leaves.
  void move(std::size_t from, std::size_t to, double mass) {
    const btVector3& v = scene.body().m_nodes[int(from)].m_v;
    cloth.water().move(from, to, mass, double(v.x()), double(v.y()), double(v.z()));
  }
  Vector momentum() {
    Vector sum = {0, 0, 0};
    for (int i = 0; i < cloth.nodeCount(); ++i) {
      const btVector3& v = scene.body().m_nodes[i].m_v;
      for (int k = 0; k < 3; ++k) sum[std::size_t(k)] += (cloth.dryMass(i) + cloth.held(i)) * double(v[k]);
    }
    return sum;
  }
  double heldSum() {
    double sum = 0;
    for (int i = 0; i < cloth.nodeCount(); ++i) sum += cloth.held(i);
    return sum;
  }
  void expectMomentum(const Vector& expected) {
    const Vector now = momentum();
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(now[k], expected[k], 10 * kTolerance * cloth.totalMass()) << k;
  }
  void expectClosed() {
    EXPECT_LE(std::fabs(cloth.ledger().imbalance()), 1e-15);
    EXPECT_NEAR(cloth.ledger().held, heldSum(), 1e-15);
  }
  BodyScene scene;
  wetcloth::WetClothWorld wet;
  wetcloth::WetCloth& cloth;
};

/// Node i gets the water of node i + 1, and the last that of the first.
std::vector<double> turned(const wetcloth::Water& water) {
  std::vector<double> held;
  for (std::size_t i = 0; i < water.size(); ++i) held.push_back(water.held((i + 1) % water.size()));
  return held;
}

TEST_IN_EVERY_WORLD(WaterMove, TakesTheVelocityOfTheNodeThatItLeaves) {
  Moving moving(GetParam());
  const btVector3 from = moving.scene.body().m_nodes[5].m_v;
  const btVector3 to = moving.scene.body().m_nodes[6].m_v;
  const double mass = moving.cloth.dryMass(6) + moving.cloth.held(6);
  const double moved = 0.5 * moving.cloth.held(5);
  ASSERT_GT(moved, 0);
  moving.step([&](wetcloth::Water&) { moving.move(5, 6, moved); });
  EXPECT_EQ(moving.scene.body().m_nodes[5].m_v, from);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(double(moving.scene.body().m_nodes[6].m_v[k]),
                (mass * double(to[k]) + moved * double(from[k])) / (mass + moved), 10 * kTolerance);
  }
}

TEST_IN_EVERY_WORLD(WaterMove, ConservesMassAndMomentum) {
  Moving moving(GetParam());
  const Vector before = moving.momentum();
  const double held = moving.heldSum();
  moving.step([&](wetcloth::Water& water) {
    for (std::size_t i = 0; i + 1 < 16; ++i) moving.move(i, i + 1, 0.3 * water.held(i));
  });
  moving.expectMomentum(before);
  moving.expectClosed();
  EXPECT_NEAR(moving.heldSum(), held, 1e-15);
}

TEST_IN_EVERY_WORLD(WaterMove, ConservesMomentumWithArrivalsAndRunOffInTheSameStep) {
  Moving moving(GetParam());
  const Vector before = moving.momentum();
  const double dry = moving.cloth.dryMass(5);
  moving.step([&](wetcloth::Water& water) {
    water.absorb(5, 0.5 * dry, 1, -7, 2);
    moving.move(5, 6, 0.4 * dry);
    water.absorb(6, 0.3 * dry, -1, 0, 3);
    moving.move(7, 5, 0.2 * dry);
  });
  moving.expectMomentum({before[0] + dry * (0.5 * 1 - 0.3), before[1] - dry * 0.5 * 7, before[2] + dry * (1.0 + 0.9)});
  moving.expectClosed();
}

TEST_IN_EVERY_WORLD(WaterMove, PassesOnWhatArrivedWithItsMomentum) {
  Moving moving(GetParam());
  const Vector before = moving.momentum();
  const double dry = moving.cloth.dryMass(5);
  const double first = 100 * dry;
  moving.step([&](wetcloth::Water& water) {
    water.absorb(5, first, 0, -9, 0);
    water.runOff(5, dry, 4, 0, 0);
    for (std::size_t i = 5; i < 9; ++i) moving.move(i, i + 1, 0.9 * water.held(i));  // more than each weighed before
    moving.move(9, 5, 0.5 * water.held(9));                                          // and round
  });
  const Vector after = moving.momentum();
  // What ran off left with node 5's velocity.
  const btVector3 v = moving.scene.body().m_nodes[5].m_v;
  const double arrived[] = {4 * dry, -9 * first, 0};
  const double tolerance = 10 * kTolerance * moving.cloth.totalMass();
  for (int k = 0; k < 3; ++k) {
    const auto c = std::size_t(k);
    EXPECT_NEAR(after[c] + dry * double(v[k]), before[c] + arrived[k], tolerance) << k;
  }
  EXPECT_LE(largestSpeed(moving.scene.body()), 9.5) << "no faster than what struck it";
  moving.expectClosed();
}

TEST_IN_EVERY_WORLD(WaterMove, MovesNoMoreThanThereIsAndNothingToItself) {
  Moving moving(GetParam());
  const double from = moving.cloth.held(5);
  const double to = moving.cloth.held(6);
  moving.step([&](wetcloth::Water& water) {
    moving.move(5, 6, 1e6);
    moving.move(3, 3, 1e6);
    moving.move(5, 7, 1);
    EXPECT_EQ(water.held(5), 0);
  });
  EXPECT_NEAR(moving.cloth.held(6), to + from, 1e-16);
  moving.expectClosed();
}

TEST_IN_EVERY_WORLD(WaterRedistribute, ConservesMass) {
  Moving moving(GetParam());
  const double held = moving.heldSum();
  const double moved = moving.cloth.water().moved();
  std::vector<double> wanted;
  moving.step([&](wetcloth::Water& water) { water.redistribute(wanted = turned(water)); });
  double gained = 0;
  for (int i = 0; i < 16; ++i) {
    EXPECT_EQ(moving.cloth.held(i), wanted[std::size_t(i)]) << i;
    gained += std::max(0.0, wanted[std::size_t(i)] - wanted[std::size_t((i + 15) % 16)]);
  }
  moving.expectClosed();
  EXPECT_NEAR(moving.heldSum(), held, 1e-15);
  EXPECT_EQ(moving.cloth.ledger().absorbed, 0);
  EXPECT_NEAR(moving.cloth.water().moved() - moved, gained, 1e-15) << "what came is what went, once";
}

TEST_IN_EVERY_WORLD(WaterRedistribute, WritesTheMassesAndLeavesTheVelocitiesToTheCaller) {
  Moving moving(GetParam());
  const std::vector<btScalar> before = stateOf(moving.scene.body());
  moving.step([](wetcloth::Water& water) { water.redistribute(turned(water)); });
  EXPECT_TRUE(sameBits(stateOf(moving.scene.body()), before));
  for (int i = 0; i < 16; ++i) {
    const double mass = moving.cloth.dryMass(i) + moving.cloth.held(i);
    EXPECT_NEAR(1 / double(moving.scene.body().m_nodes[i].m_im), mass, mass * 1e-6) << i;
  }
}

// The caller's part: each node that gained takes in the water's velocity by a push.
TEST_IN_EVERY_WORLD(WaterRedistribute, WithTheCallersPushConservesMomentum) {
  Moving moving(GetParam());
  const Vector before = moving.momentum();
  moving.step([&](wetcloth::Water& water) {
    const double moved = 0.5 * water.held(5);
    std::vector<double> held(16);
    for (std::size_t i = 0; i < 16; ++i) held[i] = water.held(i);
    held[5] -= moved;
    held[6] += moved;
    btSoftBody::Node& to = moving.scene.body().m_nodes[6];
    const btVector3 difference = moving.scene.body().m_nodes[5].m_v - to.m_v;
    const double massAfter = water.dryMass(6) + held[6];
    water.redistribute(held);
    moving.cloth.push(to, difference * btScalar(moved / massAfter));
  });
  moving.expectMomentum(before);
}

// Arrivals meet the mass that is there after the water has moved, so their own momentum comes on top of the rest,
// whichever came first.
TEST_IN_EVERY_WORLD(WaterRedistribute, ConservesMomentumWithArrivalsAndRunOffInTheSameStep) {
  for (const bool arrivesFirst : {true, false}) {
    Moving moving(GetParam());
    const double in = 0.5 * moving.cloth.dryMass(5);
    std::array<double, 16> mass = {};  // at the impact
    std::array<btVector3, 16> velocity;
    for (int i = 0; i < 16; ++i) velocity[std::size_t(i)] = moving.scene.body().m_nodes[i].m_v;
    moving.step([&](wetcloth::Water& water) {
      const auto arrive = [&] {
        water.absorb(5, in, 1, -7, 2);
        water.runOff(5, 2 * in, 3, 0, 0);
        water.absorb(6, in, 0, 0, -4);
      };
      if (arrivesFirst) arrive();
      water.redistribute(turned(water));
      if (!arrivesFirst) arrive();
      for (std::size_t i = 0; i < 16; ++i) mass[i] = water.totalMass(i);
    });
    // Node 5's own arrivals may have gone on to node 4; what it met is what it ended with, but for them.
    const double met5 = mass[5] - in;
    const double met6 = mass[6] - in;
    const btVector3 after5 = moving.scene.body().m_nodes[5].m_v;
    const btVector3 after6 = moving.scene.body().m_nodes[6].m_v;
    const double first[] = {1, -7, 2};
    for (int k = 0; k < 3; ++k) {
      const double off = k == 0 ? 3 : 0;
      EXPECT_NEAR((met5 + 3 * in) * double(after5[k]), met5 * double(velocity[5][k]) + in * first[k] + 2 * in * off,
                  10 * kTolerance * (met5 + 3 * in))
          << arrivesFirst << k;
      EXPECT_NEAR((met6 + in) * double(after6[k]), met6 * double(velocity[6][k]) + in * (k == 2 ? -4 : 0),
                  10 * kTolerance * (met6 + in))
          << arrivesFirst << k;
    }
    moving.expectClosed();
    EXPECT_NEAR(moving.cloth.ledger().absorbed, 2 * in, 1e-15);
  }
}

// A caller's sum is right to rounding only; the difference is booked, so that the ledger stays closed for good.
TEST_IN_EVERY_WORLD(WaterRedistribute, BooksTheRoundingOfTheSum) {
  Moving moving(GetParam());
  const double initial = moving.cloth.ledger().initial;
  moving.step([](wetcloth::Water& water) {
    std::vector<double> held = turned(water);
    for (double& w : held) w *= 1 + 1e-9;
    water.redistribute(held);
  });
  EXPECT_NEAR(moving.cloth.ledger().initial, initial * (1 + 1e-9), 1e-15);
  moving.expectClosed();
}

TEST_IN_EVERY_WORLD(WaterRedistribute, StaysFiniteWhenMoreMovesOnThanTheNodeWasHeavyBefore) {
  Moving moving(GetParam());
  moving.step([&](wetcloth::Water& water) {
    water.absorb(5, 100 * water.dryMass(5), 0, -9, 0);
    std::vector<double> held(16);
    for (std::size_t i = 0; i < 16; ++i) held[i] = water.held(i);
    held[5] -= 90 * water.dryMass(5);
    held[6] += 90 * water.dryMass(5);
    water.redistribute(held);
  });
  EXPECT_TRUE(isFinite(moving.scene.body()));
  EXPECT_LE(largestSpeed(moving.scene.body()), 9.5) << "no faster than what struck it";
  moving.expectClosed();
}

}  // namespace
}  // namespace wetcloth_test::water_redistribute_test
