// SPDX-License-Identifier: Zlib
// What the springs' solver keeps, however few its iterations and however hard the net.

#include "bullet_wetcloth/numerics/SpringSolver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace wetcloth_test::spring_solver_test {
namespace {

using wetcloth::Spring;
using wetcloth::SpringNode;
using wetcloth::SpringSolver;

struct Net {
  std::vector<Spring> springs;
  std::vector<SpringNode> nodes;
};

/// Free chains of ten springs of 0.1 m, shaken by 3 cm and 1 m/s.
Net shakenChains(int chains, double stiffness, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  Net net;
  for (int i = 0; i < 11 * chains; ++i) {
    SpringNode node = {};
    node.position = {0.03 * number(random), -0.1 * i + 0.03 * number(random), 0.03 * number(random)};
    node.velocity = {number(random), number(random), number(random)};
    node.mass = 0.01;
    net.nodes.push_back(node);
    if (i % 11 > 0) net.springs.push_back({i - 1, i, stiffness, 0.1});
  }
  return net;
}

void step(SpringSolver& solver, Net& net, double dt, int iterations) {
  solver.solve(net.springs, net.nodes, dt, iterations);
  for (SpringNode& node : net.nodes) {
    for (std::size_t c = 0; c < 3; ++c) {
      node.velocity[c] += node.velocityChange[c];
      node.position[c] += dt * node.velocity[c];
    }
  }
}

double energy(const Net& net) {
  double sum = 0;
  for (const SpringNode& node : net.nodes) {
    for (double v : node.velocity) sum += node.mass * v * v / 2;
  }
  for (const Spring& spring : net.springs) {
    const auto& a = net.nodes[static_cast<std::size_t>(spring.a)].position;
    const auto& b = net.nodes[static_cast<std::size_t>(spring.b)].position;
    const double stretch = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]) - spring.restLength;
    sum += spring.stiffness * stretch * stretch / 2;
  }
  return sum;
}

TEST(SpringSolver, NeverAddsEnergyWhateverTheStiffnessTheStepAndTheIterations) {
  for (const double stiffness : {1.0, 100.0, 1e4, 1e6}) {
    for (const double dt : {1.0 / 240, 1.0 / 60, 1.0 / 10}) {
      for (const int iterations : {1, 3, 10, 60}) {
        for (unsigned seed = 0; seed < 10; ++seed) {
          Net net = shakenChains(1, stiffness, seed);
          SpringSolver solver;
          solver.reset(net.nodes.size(), net.springs.size());
          const double first = energy(net);
          for (int i = 0; i < 60; ++i) {
            step(solver, net, dt, iterations);
            ASSERT_LE(energy(net), first * (1 + 1e-9)) << stiffness << " " << dt << " " << iterations << " " << seed;
          }
        }
      }
    }
  }
}

// Two chains that nothing holds, and masses that are no longer those of the factor.
TEST(SpringSolver, KeepsTheMomentumOfEachFreePart) {
  for (const int iterations : {1, 3}) {
    Net net = shakenChains(2, 1000, 4);
    SpringSolver solver;
    solver.reset(net.nodes.size(), net.springs.size());
    step(solver, net, 1.0 / 60, iterations);
    for (std::size_t i = 0; i < net.nodes.size(); ++i) net.nodes[i].mass *= 1 + 0.04 * double(i);
    solver.solve(net.springs, net.nodes, 1.0 / 60, iterations);
    EXPECT_EQ(solver.factorizations(), 1);
    for (std::size_t chain = 0; chain < 2; ++chain) {
      for (std::size_t c = 0; c < 3; ++c) {
        double change = 0;
        double size = 0;
        for (std::size_t i = 11 * chain; i < 11 * (chain + 1); ++i) {
          change += net.nodes[i].mass * net.nodes[i].velocityChange[c];
          size += net.nodes[i].mass * std::fabs(net.nodes[i].velocityChange[c]);
        }
        EXPECT_NEAR(change, 0, 1e-12 * size) << chain << " " << c;
      }
    }
  }
}

TEST(SpringSolver, ChainAtRestStaysWhereItIs) {
  Net net;
  for (int i = 0; i <= 10; ++i) {
    SpringNode node = {};
    // Link j carries the nodes below it: longer by 0.01 kg x 9.81 m/s^2 x (10 - j) / 100 N/m.
    if (i > 0) node.position[1] = net.nodes.back().position[1] - 0.1 - 0.01 * 9.81 * (11 - i) / 100;
    node.isFixed = i == 0;
    node.mass = 0.01;
    node.acceleration = {0, node.isFixed ? 0 : -9.81, 0};
    net.nodes.push_back(node);
    if (i > 0) net.springs.push_back({i - 1, i, 100, 0.1});
  }
  SpringSolver solver;
  solver.reset(net.nodes.size(), net.springs.size());
  for (const int iterations : {1, 3, 30}) {
    solver.solve(net.springs, net.nodes, 1.0 / 60, iterations);
    for (std::size_t i = 1; i <= 10; ++i) {
      EXPECT_NEAR(net.nodes[i].velocityChange[1], 9.81 / 60, 1e-10) << iterations << " " << i;
    }
  }
}

}  // namespace
}  // namespace wetcloth_test::spring_solver_test
