// SPDX-License-Identifier: Zlib
// The air's force on one triangle, against values computed by hand. No Bullet world in it.

#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"

#include <gtest/gtest.h>

#include <LinearMath/btQuaternion.h>

#include <array>
#include <cmath>
#include <random>

namespace wetcloth_test::wind_force_test {
namespace {

using wetcloth::linearWindForce;
using wetcloth::paperWindForce;
using wetcloth::quadraticWindForce;

// A force is a handful of products of btScalar: a few times 6e-8 or 1e-16 of its size.
constexpr double kRounding = kIsDouble ? 1e-14 : 2e-6;

const btVector3 kAtRest(0, 0, 0);
constexpr double kRho = 1.2;
constexpr double kDrag = 1.5;
constexpr double kSkin = 0.02;
constexpr double kLinear = 0.256;

struct Triangle {
  btVector3 a, b, c;
};

/// Its normal is (0, -1, 1) / sqrt(2), its area 2 sqrt(2).
const Triangle kTilted = {btVector3(0, 0, 0), btVector3(2, 0, 0), btVector3(0, 2, 2)};

void expectNear(const btVector3& value, const btVector3& expected, double tolerance) {
  EXPECT_LE((value - expected).length(), tolerance)
      << "(" << value.x() << ", " << value.y() << ", " << value.z() << "), expected (" << expected.x() << ", "
      << expected.y() << ", " << expected.z() << ")";
}

/// The three laws with the constants above, as one function each.
using Law = btVector3 (*)(const Triangle&, const btVector3& velocity, const btVector3& wind);
btVector3 paper(const Triangle& t, const btVector3&, const btVector3& wind) {
  return paperWindForce(t.a, t.b, t.c, wind);
}
btVector3 quadratic(const Triangle& t, const btVector3& velocity, const btVector3& wind) {
  return quadraticWindForce(t.a, t.b, t.c, velocity, wind, kRho, kDrag, kSkin);
}
btVector3 linear(const Triangle& t, const btVector3& velocity, const btVector3& wind) {
  return linearWindForce(t.a, t.b, t.c, velocity, wind, kLinear);
}
constexpr std::array<Law, 3> kLaws = {paper, quadratic, linear};

btVector3 randomVector(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> component(-size, size);
  const double x = component(random);
  const double y = component(random);
  return btVector3(btScalar(x), btScalar(y), btScalar(component(random)));
}

TEST(WindForce, OfThePaperOnATiltedTriangle) {
  // n (n . wind) with n . wind = -4 / sqrt(2)
  expectNear(paper(kTilted, kAtRest, btVector3(3, 4, 0)), btVector3(0, 2, -2), 4 * kRounding);
}

TEST(WindForce, QuadraticOnATiltedTriangle) {
  // u_n = -4 / sqrt(2), A |u_n| u_n n = 2 sqrt(2) x (-8) x (0, -1, 1) / sqrt(2) = (0, 16, -16)
  const double pressure = 0.5 * kRho * kDrag * 16;
  expectNear(quadraticWindForce(kTilted.a, kTilted.b, kTilted.c, kAtRest, btVector3(3, 4, 0), kRho, kDrag, 0),
             btVector3(0, btScalar(pressure), btScalar(-pressure)), 20 * kRounding);
}

TEST(WindForce, SkinFrictionOnATiltedTriangle) {
  // u_t = (3, 4, 0) - (0, 2, -2) = (3, 2, 2), |u_t| = sqrt(17)
  const double factor = 0.5 * kRho * kSkin * 2 * std::sqrt(2.0) * std::sqrt(17.0);
  expectNear(quadraticWindForce(kTilted.a, kTilted.b, kTilted.c, kAtRest, btVector3(3, 4, 0), kRho, 0, kSkin),
             btScalar(factor) * btVector3(3, 2, 2), kRounding);
}

TEST(WindForce, LinearOnATiltedTriangle) {
  const double factor = kLinear * 2 * std::sqrt(2.0);
  expectNear(linear(kTilted, kAtRest, btVector3(3, 4, 0)), btScalar(factor) * btVector3(0, 2, -2), 4 * kRounding);
}

TEST(WindForce, DependsOnTheSpeedRelativeToTheTriangle) {
  const btVector3 velocity(1, -2, btScalar(0.5));
  const btVector3 wind(3, 4, 0);
  for (const Law law : {quadratic, linear}) {
    expectNear(law(kTilted, velocity, wind), law(kTilted, kAtRest, wind - velocity), 50 * kRounding);
    expectNear(law(kTilted, wind, wind), kAtRest, 0);
  }
}

TEST(WindForce, SameFromTheOtherSideOfTheTriangle) {
  const Triangle flipped = {kTilted.a, kTilted.c, kTilted.b};
  const Triangle turned = {kTilted.b, kTilted.c, kTilted.a};
  const btVector3 wind(btScalar(0.3), 4, -1);
  for (const Law law : kLaws) {
    const btVector3 force = law(kTilted, kAtRest, wind);
    EXPECT_GT(force.length(), 0.1);
    expectNear(law(flipped, kAtRest, wind), force, 50 * kRounding);
    expectNear(law(turned, kAtRest, wind), force, 50 * kRounding);
  }
}

TEST(WindForce, TurnsRoundWithTheWind) {
  const btVector3 wind(3, 4, -2);
  for (const Law law : kLaws) {
    expectNear(law(kTilted, kAtRest, -wind), -law(kTilted, kAtRest, wind), 50 * kRounding);
  }
}

TEST(WindForce, AlwaysPushesAlongTheWindNeverAgainst) {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    const Triangle triangle = {randomVector(random, 1), randomVector(random, 1), randomVector(random, 1)};
    const btVector3 wind = randomVector(random, 10);
    for (const Law law : kLaws) EXPECT_GE(law(triangle, kAtRest, wind).dot(wind), 0);
  }
}

TEST(WindForce, WindAlongTheSurfacePushesOnlyByFriction) {
  const btVector3 along(0, 3, 3);
  expectNear(paper(kTilted, kAtRest, along), kAtRest, 5 * kRounding);
  expectNear(linear(kTilted, kAtRest, along), kAtRest, 5 * kRounding);
  expectNear(quadraticWindForce(kTilted.a, kTilted.b, kTilted.c, kAtRest, along, kRho, kDrag, 0), kAtRest,
             5 * kRounding);
  const double friction = 0.5 * kRho * kSkin * 2 * std::sqrt(2.0) * 18;
  EXPECT_NEAR(quadratic(kTilted, kAtRest, along).length(), friction, 5 * kRounding);
}

TEST(WindForce, GrowsWithTheSquareOfTheSpeedOrLinearly) {
  const btVector3 wind(3, 4, -2);
  expectNear(quadratic(kTilted, kAtRest, 3 * wind), 9 * quadratic(kTilted, kAtRest, wind), 5000 * kRounding);
  expectNear(linear(kTilted, kAtRest, 3 * wind), 3 * linear(kTilted, kAtRest, wind), 50 * kRounding);
  expectNear(paper(kTilted, kAtRest, 3 * wind), 3 * paper(kTilted, kAtRest, wind), 50 * kRounding);
}

TEST(WindForce, GrowsWithTheAreaButNotInThePaper) {
  const btVector3 wind(3, 4, -2);
  const Triangle larger = {5 * kTilted.a, 5 * kTilted.b, 5 * kTilted.c};
  expectNear(quadratic(larger, kAtRest, wind), 25 * quadratic(kTilted, kAtRest, wind), 5000 * kRounding);
  expectNear(linear(larger, kAtRest, wind), 25 * linear(kTilted, kAtRest, wind), 500 * kRounding);
  expectNear(paper(larger, kAtRest, wind), paper(kTilted, kAtRest, wind), 50 * kRounding);
}

TEST(WindForce, TurnsWithTheWorld) {
  std::mt19937 random(2);
  for (int i = 0; i < 50; ++i) {
    const btVector3 axis = randomVector(random, 1);
    const btQuaternion turn(axis.normalized(), btScalar(0.13 * i));
    const auto turned = [&](const btVector3& v) { return quatRotate(turn, v); };
    const Triangle triangle = {randomVector(random, 1), randomVector(random, 1), randomVector(random, 1)};
    const Triangle rotated = {turned(triangle.a), turned(triangle.b), turned(triangle.c)};
    const btVector3 velocity = randomVector(random, 3);
    const btVector3 wind = randomVector(random, 10);
    // A needle's normal is less certain than its corners by its length over its height.
    const double area = (triangle.b - triangle.a).cross(triangle.c - triangle.a).length() / 2;
    if (area < 0.1) continue;
    for (const Law law : kLaws) {
      expectNear(law(rotated, turned(velocity), turned(wind)), turned(law(triangle, velocity, wind)), 3000 * kRounding);
    }
  }
}

TEST(WindForce, TriangleWithoutAreaFeelsNothing) {
  const btVector3 p(btScalar(0.1), btScalar(0.2), btScalar(0.3));
  const Triangle flat[] = {{p, p, p},
                           {p, p, btVector3(1, 0, 0)},
                           {btVector3(0, 0, 0), btVector3(1, 0, 0), btVector3(2, 0, 0)},
                           {btVector3(0, 0, 0), btVector3(1, 2, 4), btVector3(-1, -2, -4)}};
  for (const Triangle& triangle : flat) {
    for (const Law law : kLaws) EXPECT_EQ(law(triangle, btVector3(1, 2, 3), btVector3(30, 40, 50)), kAtRest);
  }
}

}  // namespace
}  // namespace wetcloth_test::wind_force_test
