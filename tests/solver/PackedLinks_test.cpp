// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/PackedLinks.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/mesh/ClothPatch.h"
#include "tests/support/Patches.h"
#include "tests/support/SoftBodies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace wetcloth_test::packed_links_test {
namespace {

using wetcloth::findSlots;
using wetcloth::NodeSlots;
using wetcloth::PackedLinks;
using wetcloth::toSize;

// Arrays for the nodes of a body, at places and with masses at random.
struct Nodes {
  Nodes(const btSoftBody& body, const NodeSlots& slots) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(0.2, 1);
    for (wetcloth::PackedNodes::Lane& axis : position) axis.assign(slots.count + wetcloth::PackedNodes::kPadding, 0);
    inverseMass.assign(slots.count + wetcloth::PackedNodes::kPadding, 0);
    for (int k = 0; k < body.m_nodes.size(); ++k) {
      const std::size_t slot = toSize(slots.ofNode[toSize(k)]);
      for (int axis = 0; axis < 3; ++axis) {
        position[axis][slot] = body.m_nodes[k].m_x[axis] + btScalar(0.02 * number(random));
      }
      inverseMass[slot] = btScalar(100 * number(random));
    }
  }
  wetcloth::LinkedNodes linked() {
    return {{position[0].data(), position[1].data(), position[2].data()}, inverseMass.data()};
  }
  // Of the mass, times the mass.
  std::array<double, 3> centre() const {
    std::array<double, 3> sum = {0, 0, 0};
    for (std::size_t k = 0; k < inverseMass.size(); ++k) {
      if (inverseMass[k] == 0) continue;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        sum[axis] += double(position[axis][k]) / double(inverseMass[k]);
      }
    }
    return sum;
  }
  wetcloth::PackedNodes::Lane position[3];
  wetcloth::PackedNodes::Lane inverseMass;
};

PackedLinks linksOf(const btSoftBody& body, const NodeSlots& slots) {
  PackedLinks links;
  links.reset(body, slots);
  for (int k = 0; k < body.m_links.size(); ++k) links.set(toSize(k), body.m_links[k].m_rl, 0);
  return links;
}

void pass(PackedLinks& links, Nodes& nodes, const NodeSlots& slots) {
  links.prepare(nodes.linked(), btScalar(1) / 600, 0);
  for (std::size_t tile = 0; tile < slots.tiles; ++tile) links.solveTile(nodes.linked(), tile);
  links.solveOthers(nodes.linked());
}

std::unique_ptr<btSoftBody> bodyOf(const wetcloth::ClothPatch& patch, btSoftBodyWorldInfo& info) {
  auto body = patch.build(info);
  body->updateConstants();
  return body;
}

TEST(NodeSlots, AGridIsFoundByLooking) {
  btSoftBodyWorldInfo info;
  for (const auto& [columns, rows] : {std::pair{33, 17}, std::pair{8, 8}, std::pair{5, 40}, std::pair{200, 170}}) {
    wetcloth::ClothPatch patch;
    patch.columns = columns;
    patch.rows = rows;
    const auto body = bodyOf(patch, info);
    const NodeSlots slots = findSlots(*body);
    ASSERT_TRUE(slots.grid) << columns;
    EXPECT_EQ(slots.grid->columns, columns);
    EXPECT_EQ(linksOf(*body, slots).inRuns(), toSize(body->m_links.size()));
    EXPECT_EQ(std::set<int>(slots.ofNode.begin(), slots.ofNode.end()).size(), slots.ofNode.size());
  }
}

TEST(NodeSlots, BulletsPatchIsAGrid) {
  btSoftBodyWorldInfo info;
  const std::unique_ptr<btSoftBody> body(btSoftBodyHelpers::CreatePatch(
      info, btVector3(0, 0, 0), btVector3(1, 0, 0), btVector3(0, 0, 1), btVector3(1, 0, 1), 20, 31, 0, true));
  body->generateBendingConstraints(2);
  const NodeSlots slots = findSlots(*body);
  ASSERT_TRUE(slots.grid);
  EXPECT_EQ(slots.grid->columns, 20);
  EXPECT_GT(double(linksOf(*body, slots).inRuns()), 0.99 * body->m_links.size());
}

// The same patch with its nodes in another order, and without rows then.
std::unique_ptr<btSoftBody> shuffled(const wetcloth::ClothPatch& patch, btSoftBodyWorldInfo& info) {
  const auto rows = bodyOf(patch, info);
  std::vector<int> number(toSize(rows->m_nodes.size()));
  std::iota(number.begin(), number.end(), 0);
  std::shuffle(number.begin(), number.end(), std::mt19937(3));
  std::vector<btVector3> places(number.size());
  for (std::size_t k = 0; k < number.size(); ++k) places[toSize(number[k])] = rows->m_nodes[static_cast<int>(k)].m_x;
  const std::vector<btScalar> masses(number.size(), btScalar(0.01));
  auto body = std::make_unique<btSoftBody>(&info, static_cast<int>(places.size()), places.data(), masses.data());
  for (int k = 0; k < rows->m_links.size(); ++k) {
    const auto end = [&](int which) { return number[toSize(wetcloth::nodeIndex(*rows, rows->m_links[k].m_n[which]))]; };
    body->appendLink(end(0), end(1));
  }
  return body;
}

TEST(NodeSlots, OtherMeshesKeepTheirOrder) {
  btSoftBodyWorldInfo info;
  const auto body = shuffled(squarePatch(12), info);
  const NodeSlots slots = findSlots(*body);
  EXPECT_FALSE(slots.grid);
  EXPECT_EQ(slots.ofNode[77], 77);
  EXPECT_EQ(linksOf(*body, slots).inRuns(), 0u);
}

// Links are inner forces: a pass that lost or repeated one end's part would move the centre of mass.
TEST(PackedLinks, APassKeepsTheCentreOfMass) {
  btSoftBodyWorldInfo info;
  const auto expectKept = [](const btSoftBody& body) {
    const NodeSlots slots = findSlots(body);
    PackedLinks links = linksOf(body, slots);
    Nodes nodes(body, slots);
    const std::array<double, 3> before = nodes.centre();
    pass(links, nodes, slots);
    const std::array<double, 3> after = nodes.centre();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      // Each of some ten roundings of a node's place is 6e-8 of 1 m, and the mass is 0.03 kg a node.
      EXPECT_NEAR(after[axis], before[axis], 2e-8 * body.m_nodes.size()) << body.m_nodes.size();
    }
  };
  for (const auto& [columns, rows] :
       {std::pair{2, 2}, std::pair{3, 9}, std::pair{4, 4}, std::pair{9, 5}, std::pair{31, 33}, std::pair{300, 120}}) {
    wetcloth::ClothPatch patch;
    patch.columns = columns;
    patch.rows = rows;
    expectKept(*bodyOf(patch, info));
  }
  expectKept(*shuffled(squarePatch(15), info));
}

TEST(PackedLinks, PassesBringAllLinksToTheirLengths) {
  btSoftBodyWorldInfo info;
  for (const bool isGrid : {true, false}) {
    const auto body = isGrid ? bodyOf(squarePatch(9), info) : shuffled(squarePatch(9), info);
    const NodeSlots slots = findSlots(*body);
    PackedLinks links = linksOf(*body, slots);
    Nodes nodes(*body, slots);
    for (int k = 0; k < 500; ++k) pass(links, nodes, slots);
    for (int k = 0; k < body->m_links.size(); ++k) {
      const auto at = [&](int which) {
        const std::size_t slot = toSize(slots.ofNode[toSize(wetcloth::nodeIndex(*body, body->m_links[k].m_n[which]))]);
        return btVector3(nodes.position[0][slot], nodes.position[1][slot], nodes.position[2][slot]);
      };
      EXPECT_NEAR(double((at(0) - at(1)).length() / body->m_links[k].m_rl), 1, 1e-3) << k;
    }
  }
}

// C / (w + a) with a less by w / 2, as far as it stays positive. The approximant of the stretch is wrong by 2.5e-4 of
// it at 1.3 times the length.
TEST(PackedLinks, OneLinkGivesWayAsItsComplianceSays) {
  btSoftBodyWorldInfo info;
  const btVector3 places[2] = {btVector3(0, 0, 0), btVector3(1, 0, 0)};
  const btScalar masses[2] = {1, 1};
  btSoftBody body(&info, 2, places, masses);
  body.appendLink(0, 1);
  const NodeSlots slots = findSlots(body);
  const double h = 0.01;
  for (const double length : {0.9, 1.1, 1.3}) {
    for (const double compliance : {0.0, 1e-5, 1e-3}) {
      PackedLinks links;
      links.reset(body, slots);
      links.set(0, 1, btScalar(compliance));
      Nodes nodes(body, slots);
      const std::size_t a = toSize(slots.ofNode[0]);
      const std::size_t b = toSize(slots.ofNode[1]);
      for (wetcloth::PackedNodes::Lane& axis : nodes.position) axis[a] = axis[b] = 0;
      nodes.position[0][b] = btScalar(length);
      nodes.inverseMass[a] = nodes.inverseMass[b] = 1;
      links.prepare(nodes.linked(), btScalar(h), 0);
      for (std::size_t tile = 0; tile < slots.tiles; ++tile) links.solveTile(nodes.linked(), tile);
      links.solveOthers(nodes.linked());
      const double resistance = std::max(2.0, 1 + compliance / (h * h));
      const double expected = length - 2 * (length - 1) / resistance;
      EXPECT_NEAR(double(nodes.position[0][b] - nodes.position[0][a]), expected, 3e-4 * std::fabs(length - 1))
          << length;
    }
  }
}

}  // namespace
}  // namespace wetcloth_test::packed_links_test
