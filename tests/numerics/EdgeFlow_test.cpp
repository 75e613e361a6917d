// SPDX-License-Identifier: Zlib
// What moves along edges stays within what nodes hold and can hold, and takes its momentum with it.

#include "bullet_wetcloth/numerics/EdgeFlow.h"

#include "bullet_wetcloth/numerics/SparseFactor.h"
#include "tests/support/TransportScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace wetcloth_test::edge_flow_test {

using namespace transport;

namespace {

using wetcloth::FluxLimiter;
using wetcloth::MomentumFlow;
using wetcloth::WeightedEdge;
using Values = std::vector<double>;

std::vector<WeightedEdge> chain(int nodes) {
  std::vector<WeightedEdge> edges;
  for (int i = 0; i + 1 < nodes; ++i) edges.push_back({i, i + 1, 1});
  return edges;
}

Values limited(const std::vector<WeightedEdge>& edges, const Values& capacity, Values fluxes, Values held) {
  FluxLimiter limiter;
  limiter.reset(held.size());
  limiter.apply(edges, capacity, fluxes, held);
  return held;
}

double total(const Values& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

TEST(FluxLimiter, TakesWhatFitsAsItIs) {
  EXPECT_EQ(limited(chain(3), {1, 1, 1}, {0.25, -0.25}, {0.5, 0.25, 0.5}), (Values{0.25, 0.75, 0.25}));
}

// A full node may pass on as much as comes in.
TEST(FluxLimiter, LetsWaterThroughAFullNode) {
  EXPECT_EQ(limited(chain(3), {1, 1, 1}, {0.5, 0.5}, {0.75, 1, 0.25}), (Values{0.25, 1, 0.75}));
}

TEST(FluxLimiter, GivesAtMostWhatIsHeldAndTakesAtMostWhatFits) {
  EXPECT_EQ(limited(chain(2), {1, 1}, {0.75}, {0.5, 0}), (Values{0, 0.5}));
  EXPECT_EQ(limited(chain(2), {1, 1}, {0.75}, {1, 0.75}), (Values{0.75, 1}));
  // A node without enough for two gives each the same share.
  EXPECT_EQ(limited({{0, 1, 1}, {0, 2, 1}}, {1, 1, 1}, {1, 3}, {0.5, 0, 0}), (Values{0, 0.125, 0.375}));
}

TEST(FluxLimiter, AnOverfullNodeOnlyFalls) {
  EXPECT_EQ(limited(chain(2), {1, 1}, {0.5}, {0.5, 3}), (Values{0.5, 3}));
  EXPECT_EQ(limited(chain(2), {1, 1}, {-0.5}, {0.25, 3}), (Values{0.75, 2.5}));
}

TEST(FluxLimiter, HoldsAndConservesForAnyFluxes) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> share(0, 1);
  std::uniform_real_distribution<double> exponent(-12, 12);
  const int nodes = 30;
  for (int repeat = 0; repeat < 300; ++repeat) {
    std::vector<WeightedEdge> edges;
    Values fluxes;
    Values capacity;
    Values held;
    for (int i = 0; i < nodes; ++i) {
      capacity.push_back(share(random));
      held.push_back(capacity.back() * (i % 5 == 0 ? 1 : (i % 7 == 0 ? 2 : share(random))));
    }
    for (int e = 0; e < 80; ++e) {
      const int a = int(random() % nodes);
      const int b = int(random() % nodes);
      if (a == b) continue;
      edges.push_back({std::min(a, b), std::max(a, b), 1});
      fluxes.push_back((random() % 2 ? 1 : -1) * std::pow(10, exponent(random)));
    }
    if (repeat % 3 == 0) fluxes[0] = std::numeric_limits<double>::infinity();
    if (repeat % 3 == 1) fluxes[0] = std::numeric_limits<double>::quiet_NaN();
    const Values after = limited(edges, capacity, fluxes, held);
    for (std::size_t i = 0; i < held.size(); ++i) {
      EXPECT_GE(after[i], 0);
      EXPECT_LE(after[i], std::max(capacity[i], held[i]));
    }
    // 30 nodes' sums, each rounded.
    EXPECT_NEAR(total(after), total(held), 1e-13 * total(held)) << repeat;
  }
}

MomentumFlow::Node moving(double vx, double mass) { return {{vx, 0, 0}, mass, false}; }

void carry(const std::vector<WeightedEdge>& edges, const Values& fluxes, std::vector<MomentumFlow::Node>& nodes) {
  MomentumFlow flow;
  flow.reset(nodes.size(), edges);
  flow.apply(edges, fluxes, nodes);
}

// (1 x 3 + 0.5 x 2) / 1.5.
TEST(MomentumFlowAlongEdges, WaterTakesTheVelocityOfTheNodeItLeaves) {
  std::vector<MomentumFlow::Node> nodes = {moving(2, 1), moving(3, 1)};
  carry(chain(2), {0.5}, nodes);
  EXPECT_DOUBLE_EQ(nodes[0].velocity[0], 2);
  EXPECT_DOUBLE_EQ(nodes[1].velocity[0], 4 / 1.5);
}

TEST(MomentumFlowAlongEdges, EvenMotionStaysExactlyAsItIs) {
  std::vector<MomentumFlow::Node> nodes(20, {{0.1, -0.7, 1e-3}, 0.3, false});
  carry(chain(20), Values(19, 1e3), nodes);
  for (const auto& node : nodes) EXPECT_EQ(node.velocity, (std::array<double, 3>{0.1, -0.7, 1e-3}));
}

// A thousand times a node's mass goes through it: it ends with the velocity of what comes in.
TEST(MomentumFlowAlongEdges, IsStableHoweverMuchFlowsThrough) {
  std::vector<MomentumFlow::Node> nodes = {moving(1, 1e4), moving(0, 1), moving(0, 1), moving(0, 1)};
  carry(chain(4), Values(3, 1000), nodes);
  EXPECT_NEAR(nodes[1].velocity[0], 1000 / 1001.0, 1e-12);
  EXPECT_NEAR(nodes[2].velocity[0], std::pow(1000 / 1001.0, 2), 1e-12);
}

// Momentum, with the masses before and after; velocities stay among those that there were.
TEST(MomentumFlowAlongEdges, ConservesMomentumForAnyFluxes) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> value(-1, 1);
  const int count = 25;
  for (int repeat = 0; repeat < 200; ++repeat) {
    std::vector<MomentumFlow::Node> nodes;
    for (int i = 0; i < count; ++i) nodes.push_back(moving(value(random), 0.1 + std::fabs(value(random))));
    std::vector<WeightedEdge> edges;
    Values fluxes;
    Values after;
    for (const auto& node : nodes) after.push_back(node.mass);
    for (int e = 0; e < 60; ++e) {
      const int a = int(random() % count);
      const int b = int(random() % count);
      if (a == b) continue;
      // Every other time downhill only, as a potential drives it; else in circles, too.
      const bool isDownhill = repeat % 2 == 0;
      const double flux = (isDownhill ? std::fabs(value(random)) : value(random)) * (repeat % 3 == 0 ? 100 : 0.01);
      edges.push_back({std::min(a, b), std::max(a, b), 1});
      fluxes.push_back(flux);
      after[std::size_t(std::min(a, b))] -= flux;
      after[std::size_t(std::max(a, b))] += flux;
    }
    double before = 0;
    for (const auto& node : nodes) before += node.mass * node.velocity[0];
    carry(edges, fluxes, nodes);
    double now = 0;
    double size = 0;
    for (int i = 0; i < count; ++i) {
      now += after[std::size_t(i)] * nodes[std::size_t(i)].velocity[0];
      size += std::fabs(after[std::size_t(i)]);
      EXPECT_LE(std::fabs(nodes[std::size_t(i)].velocity[0]), 1 + 1e-12);
    }
    EXPECT_NEAR(now, before, 1e-12 * size) << repeat;
  }
}

TEST(MomentumFlowAlongEdges, AFixedNodeIsAWall) {
  std::vector<MomentumFlow::Node> nodes = {moving(1, 1), {{0, 0, 0}, 1, true}, moving(1, 1)};
  carry(chain(3), {0.5, 1}, nodes);
  EXPECT_EQ(nodes[1].velocity[0], 0);
  EXPECT_DOUBLE_EQ(nodes[0].velocity[0], 1);
  EXPECT_DOUBLE_EQ(nodes[2].velocity[0], 0.5);
}

TEST(MomentumFlowAlongEdges, WaterThatGoesInACircleStirs) {
  std::vector<MomentumFlow::Node> nodes = {moving(3, 1), moving(0, 1), moving(0, 1)};
  carry({{0, 1, 1}, {0, 2, 1}, {1, 2, 1}}, {7, -7, 7}, nodes);
  for (const auto& node : nodes) EXPECT_NEAR(node.velocity[0], 1, 1e-15);
}

TEST(SparseFactor, SolvesForOneAndForThreeRightHandSidesAlike) {
  const int n = 50;
  Eigen::SparseMatrix<double> matrix(n, n);
  for (int i = 0; i < n; ++i) {
    matrix.insert(i, i) = 3 + i % 4;
    if (i + 1 < n) matrix.insert(i + 1, i) = -1;
    if (i + 7 < n) matrix.insert(i + 7, i) = -0.5;
  }
  matrix.makeCompressed();
  wetcloth::SparseFactor factor;
  factor.compute(matrix);
  ASSERT_EQ(factor.size(), 50u);
  std::vector<std::array<double, 1>> one(n);
  std::vector<std::array<double, 3>> three(n);
  for (int i = 0; i < n; ++i) {
    one[std::size_t(factor.row(i))] = {std::sin(i)};
    three[std::size_t(factor.row(i))] = {std::cos(i), std::sin(i), 1};
  }
  factor.solveInPlace(one);
  factor.solveInPlace(three);
  Eigen::VectorXd x(n);
  for (int i = 0; i < n; ++i) {
    x[i] = one[std::size_t(factor.row(i))][0];
    EXPECT_EQ(three[std::size_t(factor.row(i))][1], x[i]);
  }
  const Eigen::VectorXd back = matrix.selfadjointView<Eigen::Lower>() * x;
  for (int i = 0; i < n; ++i) EXPECT_NEAR(back[i], std::sin(i), 1e-14);
}

}  // namespace
}  // namespace wetcloth_test::edge_flow_test
