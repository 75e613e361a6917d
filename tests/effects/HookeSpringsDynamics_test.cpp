// SPDX-License-Identifier: Zlib
// Springs in motion: the force itself, conserved quantities, periods, stiff springs and long steps.

#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Measures.h"
#include "tests/support/Patches.h"
#include "tests/support/SoftBodies.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace wetcloth_test::hooke_springs_dynamics_test {
namespace {

using wetcloth::HookeSprings;

constexpr double kPi = 3.14159265358979323846;

HookeSprings::Parameters springs(double stiffness) {
  HookeSprings::Parameters parameters;
  parameters.stiffness = stiffness;
  return parameters;
}

// --- the force -----------------------------------------------------------------------------------------------------

TEST(HookeForce, PullsAStretchedEndTowardsTheOther) {
  // 3-4-5: stretched from 4 to 5 m, 10 N/m x 1 m along (0.6, 0.8, 0)
  const btVector3 force = wetcloth::hookeForce(btVector3(1, 1, 1), btVector3(4, 5, 1), 4, 10);
  EXPECT_NEAR(force.x(), 6, 1e-5);
  EXPECT_NEAR(force.y(), 8, 1e-5);
  EXPECT_NEAR(force.z(), 0, 1e-5);
}

TEST(HookeForce, PushesACompressedEndAway) {
  EXPECT_NEAR(wetcloth::hookeForce(btVector3(0, 0, 0), btVector3(1, 0, 0), 3, 10).x(), -20, 1e-4);
}

TEST(HookeForce, IsZeroAtRestLengthAndWhereTheEndsMeet) {
  EXPECT_NEAR(wetcloth::hookeForce(btVector3(0, 0, 0), btVector3(0, 2, 0), 2, 1e3).length(), 0, 1e-3);
  EXPECT_EQ(wetcloth::hookeForce(btVector3(1, 2, 3), btVector3(1, 2, 3), 1, 10), kNoGravity);
}

TEST(HookeForce, ActsAlikeOnBothEnds) {
  const btVector3 a(btScalar(0.1), 2, -1);
  const btVector3 b(3, btScalar(0.4), 1);
  EXPECT_LE((wetcloth::hookeForce(a, b, 1, 7) + wetcloth::hookeForce(b, a, 1, 7)).length(), 1e-5);
}

// --- conserved quantities --------------------------------------------------------------------------------------------

/// Stretches and shakes a rope that lies somewhere in space.
void disturb(btSoftBody& body, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    btSoftBody::Node& node = body.m_nodes[i];
    if (node.m_im == 0) continue;
    const double x = number(random);
    const double y = number(random);
    const double z = number(random);
    node.m_x += btVector3(btScalar(0.03 * x), btScalar(0.03 * y), btScalar(0.03 * z));
    node.m_q = node.m_x;
    node.m_v = btVector3(btScalar(z), btScalar(x), btScalar(y));
    node.m_vn = node.m_v;
  }
}

/// Kinetic and elastic energy of a body whose links are springs of one stiffness [J].
double energy(const btSoftBody& body, double stiffness) {
  double sum = 0;
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    const btSoftBody::Node& node = body.m_nodes[i];
    if (node.m_im > 0) sum += double(node.m_v.length2()) / double(node.m_im) / 2;
  }
  for (int i = 0; i < body.m_links.size(); ++i) {
    const btSoftBody::Link& link = body.m_links[i];
    const double stretch = double((link.m_n[0]->m_x - link.m_n[1]->m_x).length()) - double(link.m_rl);
    sum += stiffness * stretch * stretch / 2;
  }
  return sum;
}

TEST_IN_EVERY_WORLD(HookeSpringsDynamics, FreeChainKeepsItsMomentum) {
  for (double stiffness : {10.0, 1e4}) {
    ClothScene scene(GetParam(), kNoGravity, hangingRope(10, 0.1, 0.01, false));
    scene.cloth().add<HookeSprings>(springs(stiffness));
    scene.cloth().setSaturation(0.5);
    disturb(scene.body(), 3);
    setVelocity(scene.body(), btVector3(0, 0, 0));
    for (int i = 0; i < 5; ++i) scene.node(i).m_v = scene.node(i).m_vn = btVector3(1, btScalar(0.5), -1);
    const auto before = momentum(scene.body());
    scene.step(256, kExactSubstep);
    const auto after = momentum(scene.body());
    // The implicit world solves by conjugate gradients to 1e-7 in either precision; float32 rounds each of 256 steps
    // and 10 nodes to 1e-7 of its position, over a step of 4 ms.
    const double size = std::hypot(before[0], before[1], before[2]);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(after[k], before[k], size * (kIsDouble ? 1e-9 : 2e-4)) << k << " " << stiffness;
    }
  }
}

TEST_IN_EVERY_WORLD(HookeSpringsDynamics, FreeFallIsAsWithoutSprings) {
  const auto fallen = [](bool withSprings) {
    ClothScene scene(GetParam(), kEarthGravity, hangingRope(10, 0.1, 0.01, false));
    if (withSprings) scene.cloth().add<HookeSprings>(springs(1000));
    scene.step(240);
    std::vector<double> heights;
    for (int i = 0; i <= 10; ++i) heights.push_back(double(scene.node(i).m_x.y()));
    return heights;
  };
  const std::vector<double> with = fallen(true);
  const std::vector<double> without = fallen(false);
  for (std::size_t i = 0; i <= 10; ++i) {
    // Float32 knows a height of 5 m to 2.4e-7 m, and so a velocity to 6e-5 m/s, over and over for 240 steps.
    EXPECT_NEAR(with[i], without[i], kIsDouble ? 1e-6 : 1e-3) << i;
    EXPECT_NEAR(with[i], -0.1 * double(i) - 9.81 / 2, 9.81 * kSubstep) << i;  // first order in the step
  }
}

// Along its own line a chain is linear, and backward Euler only takes energy away.
TEST_IN_EVERY_WORLD(HookeSpringsDynamics, EnergyOfAStretchedChainNeverRises) {
  for (double stiffness : {1.0, 100.0, 1e4, 1e6}) {
    for (double dt : {1.0 / 240, 1.0 / 60, 1.0 / 10}) {
      ClothScene scene(GetParam(), kNoGravity, hangingRope(10, 0.1, 0.01, false));
      scene.cloth().add<HookeSprings>(springs(stiffness));
      for (int i = 0; i <= 10; ++i) {
        scene.node(i).m_x *= btScalar(1 + 0.02 * i);
        scene.node(i).m_q = scene.node(i).m_x;
      }
      const double first = energy(scene.body(), stiffness);
      double before = first;
      for (int step = 0; step < 60; ++step) {
        scene.step(1, dt);
        const double after = energy(scene.body(), stiffness);
        // Float32 knows a spring's length to 1e-7 m: k x 0.1 m x 1e-7 m, of a start with k (0.03 m)^2.
        ASSERT_LE(after, before + first * (kIsDouble ? 1e-6 : 3e-5))
            << "k " << stiffness << " dt " << dt << " " << step;
        before = after;
      }
      EXPECT_LT(before, first);
    }
  }
}

// Crumpled, compressed springs give way sideways and the energy of a step may rise a little; it must not run away.
TEST_IN_EVERY_WORLD(HookeSpringsDynamics, EnergyOfAShakenChainStaysBounded) {
  for (double stiffness : {1.0, 100.0, 1e4, 1e6}) {
    for (double dt : {1.0 / 240, 1.0 / 60, 1.0 / 10}) {
      ClothScene scene(GetParam(), kNoGravity, hangingRope(10, 0.1, 0.01, false));
      scene.cloth().add<HookeSprings>(springs(stiffness));
      disturb(scene.body(), 5);
      const double first = energy(scene.body(), stiffness);
      double most = 0;
      for (int step = 0; step < 240; ++step) {
        scene.step(1, dt);
        most = std::max(most, energy(scene.body(), stiffness));
      }
      EXPECT_LT(most, 1.05 * first) << "k " << stiffness << " dt " << dt;
      EXPECT_LT(energy(scene.body(), stiffness), 0.9 * first) << "k " << stiffness << " dt " << dt;
    }
  }
}

TEST_IN_EVERY_WORLD(HookeSpringsDynamics, StiffSpringsAndLongStepsStayFinite) {
  for (double stiffness : {1.0, 1e6, 1e9, 1e300}) {
    for (double dt : {1e-4, 1.0 / 240, 1.0 / 10, 1.0}) {
      ClothScene scene(GetParam(), kEarthGravity, hangingRope(10, 0.1, 1e-5));
      scene.cloth().add<HookeSprings>(springs(stiffness));
      disturb(scene.body(), 9);
      scene.step(50, dt);
      // Hung 1 m below its pin, it can fall and swing, and a soft spring (1 N/m) is stretched by 1e-4 N x 10 at most.
      const double reach = 2 + 9.81 * dt * dt * 50;
      for (int i = 0; i <= 10; ++i) {
        const double distance = double(scene.node(i).m_x.length());
        ASSERT_TRUE(std::isfinite(distance)) << stiffness << " " << dt;
        ASSERT_LT(distance, reach) << stiffness << " " << dt << " node " << i;
      }
    }
  }
}

// What hangs as long as at rest can fall no farther than its links give way, whatever else holds it.
TEST_IN_EVERY_WORLD(HookeSpringsDynamics, SpringsStifferThanNumbersCanTellHangStill) {
  constexpr int kNodes = 10;
  const wetcloth::ClothPatch patch = hangingPatch(kNodes);
  for (const double stiffness : {1e3, 1e300}) {
    for (const double bendingStiffness : {1e9, 1e19, 1e30, 1e300}) {
      ClothScene scene(GetParam(), kEarthGravity, patch);
      std::vector<btVector3> places;
      for (int i = 0; i < scene.body().m_nodes.size(); ++i) places.push_back(scene.node(i).m_x);
      HookeSprings::Parameters parameters = springs(stiffness);
      parameters.bendingStiffness = bendingStiffness;
      scene.cloth().add<HookeSprings>(parameters);
      // Columns stretch by half of weight / k in all, at most twice that as it comes down: 2 mm. Five times as much is
      // far from what loses the masses beside the springs: metres.
      const double weight = 9.81 * double(scene.body().getTotalMass());
      const double reach = 5 * weight / (kNodes * 1e3) * (kNodes - 1);
      for (int step = 0; step < 240; ++step) {
        scene.step(1, kSubstep);
        for (int i = 0; i < scene.body().m_nodes.size(); ++i) {
          ASSERT_LT(double((scene.node(i).m_x - places[std::size_t(i)]).length()), reach)
              << stiffness << " " << bendingStiffness << " node " << i << " step " << step;
        }
      }
    }
  }
}

/// Period of a mass on a pinned spring, from its passages through the rest length [s].
double period(WorldKind world, double stiffness, double mass, double dt, int periods) {
  ClothScene scene(world, kNoGravity, hangingRope(1, 1, mass));
  scene.cloth().add<HookeSprings>(springs(stiffness));
  scene.node(1).m_x.setY(btScalar(-1.1));
  scene.node(1).m_q = scene.node(1).m_x;
  double previous = -1.1;
  double first = -1;
  int passages = 0;
  for (int step = 1; step < 1000000; ++step) {
    scene.step(1, dt);
    const double y = double(scene.node(1).m_x.y());
    if ((y + 1) * (previous + 1) < 0) {
      const double time = dt * (step - (y + 1) / (y - previous));
      if (first < 0) {
        first = time;
      } else if (++passages == 2 * periods) {
        return (time - first) / periods;
      }
    }
    previous = y;
  }
  return -1;
}

TEST_IN_EVERY_WORLD(HookeSpringsDynamics, PeriodOfAMassOnASpringApproachesTheClosedForm) {
  const double exact = 2 * kPi * std::sqrt(0.1 / 40);  // 0.314 s
  for (double dt : {1.0 / 256, 1.0 / 1024}) {
    // Backward Euler turns by atan(w dt) in a step, whose error is (w dt)^2 / 3.
    const double omega = 20;
    const double discrete = 2 * kPi * dt / std::atan(omega * dt);
    // Read off between two steps, to second order in w dt.
    EXPECT_NEAR(period(GetParam(), 40, 0.1, dt, 3) / discrete, 1, 1e-3) << dt;
  }
  EXPECT_NEAR(period(GetParam(), 40, 0.1, 1.0 / 1024, 3) / exact, 1, 2e-3);
}

/// L_n(x) of Laguerre.
double laguerre(int n, double x) {
  double before = 0;
  double value = 1;
  for (int i = 0; i < n; ++i) {
    const double next = ((2 * i + 1 - x) * value - i * before) / (i + 1);
    before = value;
    value = next;
  }
  return value;
}

/// Where L_n, which is 1 at 0, first is 0.
double firstRootOfLaguerre(int n) {
  double low = 0;
  double high = 2.0 / n;  // the root is about 1.446 / n
  while (high - low > 1e-12) {
    const double middle = (low + high) / 2;
    (laguerre(n, middle) > 0 ? low : high) = middle;
  }
  return low;
}

// A chain of n light, stiff links of length a in its slowest mode: node i from below is displaced by L_i(r), r the
// first root of L_n, and omega^2 = r g / a. So it follows from T_i = (i + 1) m g and L's own recurrence.
TEST_IN_EVERY_WORLD(HookeSpringsDynamics, PeriodOfAHangingChainIsThatOfItsSlowestMode) {
  const int links = 20;
  const double length = 0.05;
  const double root = firstRootOfLaguerre(links);
  const double exact = 2 * kPi / std::sqrt(root * 9.81 / length);  // 1.67 s
  for (const double dt : {1.0 / 120, 1.0 / 240}) {
    ClothScene scene(GetParam(), kEarthGravity, hangingRope(links, length, 2.4e-4));
    scene.cloth().add<HookeSprings>(springs(1000));
    for (int i = 1; i <= links; ++i) {
      scene.node(i).m_x.setX(btScalar(0.03 * laguerre(links - i, root)));
      scene.node(i).m_q = scene.node(i).m_x;
    }
    double previous = 0.03;
    std::vector<double> passages;
    for (int step = 1; step < 5 / dt; ++step) {
      scene.step(1, dt);
      const double x = double(scene.node(links).m_x.x());
      if ((x > 0) != (previous > 0)) passages.push_back(dt * (step - x / (x - previous)));
      previous = x;
    }
    ASSERT_GE(passages.size(), 3u) << dt;
    const double measured = 2 * (passages.back() - passages.front()) / double(passages.size() - 1);
    EXPECT_NEAR(measured / exact, 1, 0.03) << dt;
  }
}

}  // namespace
}  // namespace wetcloth_test::hooke_springs_dynamics_test
