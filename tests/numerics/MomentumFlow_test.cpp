// SPDX-License-Identifier: Zlib
// Momentum is kept and no velocity is outside of what there was, whether nodes give little or many times their mass.

#include "bullet_wetcloth/numerics/MomentumFlow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace wetcloth_test::momentum_flow_test {
namespace {

using wetcloth::MomentumFlow;
using wetcloth::WeightedEdge;

struct Flow {
  std::vector<WeightedEdge> edges;
  std::vector<double> fluxes;
  std::vector<MomentumFlow::Node> nodes;

  std::vector<double> masses() const {
    std::vector<double> after;
    for (const MomentumFlow::Node& node : nodes) after.push_back(node.mass);
    for (std::size_t e = 0; e < edges.size(); ++e) {
      after[static_cast<std::size_t>(edges[e].a)] -= fluxes[e];
      after[static_cast<std::size_t>(edges[e].b)] += fluxes[e];
    }
    return after;
  }
  void apply() {
    MomentumFlow flow;
    flow.reset(nodes.size(), edges);
    flow.apply(edges, fluxes, nodes);
  }
};

// Water runs down a row of nodes and through shortcuts, `size` kg through each edge at most, of nodes of 1 kg. No node
// gives more than it has and gets, since none is a net loser of more than a quarter.
Flow cascade(double size) {
  Flow flow;
  unsigned seed = 3;
  const auto random = [&] { return static_cast<double>((seed = seed * 1664525 + 1013904223) >> 8) / 16777216.0; };
  const int count = 30;
  for (int i = 0; i < count; ++i) flow.nodes.push_back({{random() - 0.5, random(), 3 * random()}, 1, false});
  for (int i = 0; i + 1 < count; ++i) {
    flow.edges.push_back({i, i + 1, 1});
    flow.fluxes.push_back(size + 0.2 * random());
  }
  flow.fluxes.front() = 0.2;
  flow.fluxes[1] = 0.4;
  for (std::size_t e = 2; e < flow.fluxes.size(); ++e) {
    flow.fluxes[e] = std::min(flow.fluxes[e], flow.fluxes[e - 1] + 0.2);
  }
  return flow;
}

TEST(MomentumFlow, KeepsMomentumAndMakesNoNewVelocities) {
  for (const double size : {1e-6, 0.1, 0.7, 2.0, 5.0}) {
    Flow flow = cascade(size);
    const std::vector<MomentumFlow::Node> before = flow.nodes;
    const std::vector<double> after = flow.masses();
    flow.apply();
    for (std::size_t c = 0; c < 3; ++c) {
      double change = 0;
      double low = 1e9;
      double high = -1e9;
      for (const MomentumFlow::Node& node : before) {
        low = std::min(low, node.velocity[c]);
        high = std::max(high, node.velocity[c]);
      }
      for (std::size_t i = 0; i < before.size(); ++i) {
        ASSERT_GT(after[i], 0);
        change += after[i] * flow.nodes[i].velocity[c] - before[i].mass * before[i].velocity[c];
        EXPECT_GE(flow.nodes[i].velocity[c], low - 1e-14) << size;
        EXPECT_LE(flow.nodes[i].velocity[c], high + 1e-14) << size;
      }
      EXPECT_NEAR(change, 0, 1e-12) << size;  // rounding of some hundred sums of order 1
    }
  }
}

TEST(MomentumFlow, LittleWaterLeavesWithTheVelocityBefore) {
  Flow flow;
  flow.nodes = {{{1, 0, 0}, 1, false}, {{0, 2, 0}, 3, false}, {{0, 0, 4}, 1, false}};
  flow.edges = {{0, 1, 1}, {1, 2, 1}};
  flow.fluxes = {0.5, 0.25};
  flow.apply();
  EXPECT_DOUBLE_EQ(flow.nodes[0].velocity[0], 1);
  EXPECT_DOUBLE_EQ(flow.nodes[1].velocity[0], 0.5 / 3.25);
  EXPECT_DOUBLE_EQ(flow.nodes[1].velocity[1], 2 * 2.75 / 3.25);
  EXPECT_DOUBLE_EQ(flow.nodes[2].velocity[1], 2 * 0.25 / 1.25);
  EXPECT_DOUBLE_EQ(flow.nodes[2].velocity[2], 4 / 1.25);
}

TEST(MomentumFlow, EvenMotionStaysAsItIsAndFixedNodesKeepTheirs) {
  for (const double size : {0.1, 5.0}) {
    Flow flow = cascade(size);
    for (MomentumFlow::Node& node : flow.nodes) node.velocity = {0.1, 0.2, 0.3};
    flow.apply();
    for (const MomentumFlow::Node& node : flow.nodes) {
      EXPECT_EQ(node.velocity, (std::array<double, 3>{0.1, 0.2, 0.3})) << size;
    }
    flow = cascade(size);
    flow.nodes[4].isFixed = true;
    const auto kept = flow.nodes[4].velocity;
    flow.apply();
    EXPECT_EQ(flow.nodes[4].velocity, kept) << size;
  }
}

}  // namespace
}  // namespace wetcloth_test::momentum_flow_test
