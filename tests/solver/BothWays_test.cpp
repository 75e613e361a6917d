// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/BothWays.h"
#include "tests/solver/SolverScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <set>
#include <utility>
#include <vector>

namespace wetcloth_test::both_ways_test {
namespace {

using wetcloth::needsBothWays;

// A sheet of side x side nodes that hangs by its upper corners; each row stands `shear` further than its height, and
// it is `width` wide. Its links are the edges of its triangles, and as many more as bending constraints over that
// distance make.
BodyBuilder shearedSheet(int side, double width, double shear, int bending = 0) {
  return [=](btSoftBodyWorldInfo& info) {
    std::vector<btVector3> places;
    std::vector<std::array<int, 3>> faces;
    for (int row = 0; row < side; ++row) {
      for (int column = 0; column < side; ++column) {
        const double fall = double(row) / (side - 1);
        places.emplace_back(btScalar(width * column / (side - 1) + shear * fall), btScalar(-fall), btScalar(0));
        if (row + 1 == side || column + 1 == side) continue;
        const int k = row * side + column;
        faces.push_back({k, k + 1, k + side});
        faces.push_back({k + 1, k + side + 1, k + side});
      }
    }
    auto body = triangles(places, std::vector<btScalar>(places.size(), btScalar(2e-3)), faces)(info);
    std::set<std::pair<int, int>> edges;
    for (const auto& face : faces) {
      for (std::size_t k = 0; k < 3; ++k) edges.insert(std::minmax({face[k], face[(k + 1) % 3]}));
    }
    for (const auto& [a, b] : edges) body->appendLink(a, b);
    if (bending > 0) body->generateBendingConstraints(bending);
    body->setMass(0, 0);
    body->setMass(side - 1, 0);
    return body;
  };
}

// Of the nodes that move, over their mass [m^2/s^2].
double kineticEnergyOf(const btSoftBody& body) {
  double energy = 0;
  double mass = 0;
  for (int k = 0; k < body.m_nodes.size(); ++k) {
    const btSoftBody::Node& node = body.m_nodes[k];
    if (!(node.m_im > 0)) continue;
    energy += double(node.m_v.length2()) / 2 / double(node.m_im);
    mass += 1 / double(node.m_im);
  }
  return energy / mass;
}

// Gusts fold the sheet, and then nothing moves it but its weight. Damping takes half of its energy every second, so of
// the 5 m^2/s^2 that a fall of half its height gives, 0.02 are left after 8 s; one that keeps trembling has 0.1 to 14.
double energyAfterGusts(const BodyBuilder& builder, int smallStepCount) {
  SolverScene scene(WorldKind::softRigid, kEarthGravity, smallSteps(smallStepCount));
  btSoftBody& body = scene.add(builder);
  body.m_cfg.kDP = btScalar(1 - std::pow(0.5, 0.5 / 60));
  for (int step = 0; step < 300; ++step) {
    for (int k = 0; k < body.m_nodes.size(); ++k) {
      const btScalar gust = btScalar(step / 20 % 2 == 0 ? 0.15 : -0.1);
      if (body.m_nodes[k].m_im > 0) body.m_nodes[k].m_v += btVector3(0, btScalar(0.02), gust);
    }
    scene.step(1);
  }
  scene.step(8 * 60);
  return kineticEnergyOf(body);
}

TEST(BothWays, ASheetLeftAloneCalmsDown) {
  for (const int count : {10, 20}) {
    EXPECT_LT(energyAfterGusts(shearedSheet(6, 1, 3), count), 0.05);     // obtuse
    EXPECT_LT(energyAfterGusts(shearedSheet(6, 0.33, 0), count), 0.05);  // needles
    EXPECT_LT(energyAfterGusts(shearedSheet(6, 1, 3, 2), count), 0.05);  // obtuse, with bending links
    EXPECT_LT(energyAfterGusts(shearedSheet(6, 10, 0.5), count), 0.05);  // wide
    EXPECT_LT(energyAfterGusts(shearedSheet(6, 1, 0), count), 0.05);     // square
  }
}

TEST(BothWays, ClothsOfFewOrNearlyParallelLinksNeedThem) {
  btSoftBodyWorldInfo info;
  EXPECT_TRUE(needsBothWays(*shearedSheet(8, 1, 0)(info)));
  EXPECT_FALSE(needsBothWays(*shearedSheet(8, 1, 0, 2)(info)));
  EXPECT_FALSE(needsBothWays(*shearedSheet(8, 1, 1, 2)(info)));
  EXPECT_TRUE(needsBothWays(*shearedSheet(8, 1, 3, 2)(info)));
  EXPECT_FALSE(needsBothWays(*squarePatch(8).build(info)));
  EXPECT_FALSE(needsBothWays(*hangingRope(10, 0.1, 0.01)(info)));
}

// Not sheared but for one row in twelve, which has the only obtuse triangles.
BodyBuilder unevenSheet() {
  return [](btSoftBodyWorldInfo& info) {
    constexpr int kSide = 13;
    auto body = shearedSheet(kSide, 1, 0, 2)(info);
    for (int k = 0; k < body->m_nodes.size(); ++k) {
      const int shearedRows = k / kSide / 7;
      body->m_nodes[k].m_x += btVector3(btScalar(shearedRows * 3.0 / (kSide - 1)), 0, 0);
      body->m_nodes[k].m_q = body->m_nodes[k].m_x;
    }
    for (int k = 0; k < body->m_links.size(); ++k) {
      btSoftBody::Link& link = body->m_links[k];
      link.m_rl = (link.m_n[0]->m_x - link.m_n[1]->m_x).length();
    }
    body->updateConstants();
    return body;
  };
}

TEST(BothWays, AFewObtuseTrianglesDoNoHarmAndDoNotSlowAClothDown) {
  btSoftBodyWorldInfo info;
  EXPECT_FALSE(needsBothWays(*unevenSheet()(info)));
  for (const int count : {10, 20}) EXPECT_LT(energyAfterGusts(unevenSheet(), count), 0.05);
}

// The law of the sides asks for rest lengths, not for where a crumpled cloth's nodes are.
TEST(BothWays, HowAClothLiesDoesNotMatter) {
  btSoftBodyWorldInfo info;
  const auto sheet = shearedSheet(8, 1, 0, 2)(info);
  for (int k = 0; k < sheet->m_nodes.size(); ++k) sheet->m_nodes[k].m_x.setY(sheet->m_nodes[k].m_x.y() / 100);
  EXPECT_FALSE(needsBothWays(*sheet));
}

// A ribbon whose links are those of its triangles' edges, so that it has both ways: its rungs share the weight between
// two strands, of which each stretches as a rope of half the weight.
TEST(BothWays, ARibbonStretchesAsItsStiffnessSays) {
  constexpr int kLinks = 20;
  constexpr double kMass = 0.002;
  constexpr double kLength = 0.05;
  const double stiffness = kMass * 9.81 * kLinks / (0.2 * kLength);
  for (const double wetness : {1.0, 1.84}) {
    SolverScene scene(WorldKind::softRigid, kEarthGravity, smallSteps(10, stiffness));
    btSoftBody& ribbon = scene.add([&](btSoftBodyWorldInfo& info) {
      std::vector<btVector3> places;
      std::vector<std::array<int, 3>> faces;
      for (int k = 0; k <= kLinks; ++k) {
        for (int side = 0; side < 2; ++side) places.emplace_back(btScalar(side), btScalar(-k * kLength), btScalar(0));
      }
      auto body = triangles(places, std::vector<btScalar>(places.size(), btScalar(kMass * wetness)), faces)(info);
      for (int k = 0; k <= kLinks; ++k) {
        body->appendLink(2 * k, 2 * k + 1);
        if (k < kLinks) body->appendLink(2 * k, 2 * k + 2);
        if (k < kLinks) body->appendLink(2 * k + 1, 2 * k + 3);
      }
      body->setMass(0, 0);
      body->setMass(1, 0);
      return body;
    });
    ribbon.m_cfg.kDP = btScalar(0.05);
    ASSERT_TRUE(needsBothWays(ribbon));
    scene.step(1200);
    const double expected = kMass * wetness * 9.81 / stiffness * kLinks * (kLinks + 1) / 2;
    for (const int end : {2 * kLinks, 2 * kLinks + 1}) {
      EXPECT_NEAR(-double(ribbon.m_nodes[end].m_x.y()) - kLinks * kLength, expected, 0.05 * expected) << wetness;
    }
    EXPECT_TRUE(scene.messages().empty());
  }
}

}  // namespace
}  // namespace wetcloth_test::both_ways_test
