// SPDX-License-Identifier: Zlib
#include "command/scene/StableSprings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>

namespace command {
namespace {

constexpr double stiffest = 100;       // where nothing forbids it [N/m]
constexpr double stiffestBending = 1;  // [N/m]
constexpr double squaredPhase = 1.5;   // (w dt)^2; 4 is the end of stability
constexpr int rounds = 60;             // of power iteration: within some percent

using Vectors = std::vector<std::array<double, 3>>;

double scaledToOne(Vectors& vectors) {
  double squares = 0;
  for (const auto& vector : vectors) {
    for (const double x : vector) squares += x * x;
  }
  const double length = std::sqrt(squares);
  for (auto& vector : vectors) {
    for (double& x : vector) x = length > 0 ? x / length : 0;
  }
  return length;
}

/// A spring of 1 N/m along a link.
struct Spring {
  std::size_t a, b;
  std::array<double, 3> along;
};

std::vector<Spring> springsAlongLinks(const btSoftBody& body) {
  std::vector<Spring> springs;
  springs.reserve(static_cast<std::size_t>(body.m_links.size()));
  for (int k = 0; k < body.m_links.size(); ++k) {
    const btSoftBody::Link& link = body.m_links[k];
    const btVector3 along = (link.m_n[1]->m_x - link.m_n[0]->m_x).normalized();
    springs.push_back(
        {static_cast<std::size_t>(link.m_n[0] - &body.m_nodes[0]),
         static_cast<std::size_t>(link.m_n[1] - &body.m_nodes[0]),
         {static_cast<double>(along.x()), static_cast<double>(along.y()), static_cast<double>(along.z())}});
  }
  return springs;
}

/// Of the nodes' inverse masses.
std::vector<double> rootsOf(const btSoftBody& body) {
  std::vector<double> roots;
  roots.reserve(static_cast<std::size_t>(body.m_nodes.size()));
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    roots.push_back(std::sqrt(static_cast<double>(body.m_nodes[i].m_im)));
  }
  return roots;
}

/// M^-1/2 K M^-1/2 of the springs.
Vectors pulled(const std::vector<Spring>& springs, const std::vector<double>& roots, const Vectors& moved) {
  Vectors result(moved.size(), {0, 0, 0});
  for (const Spring& spring : springs) {
    const double rootA = roots[spring.a];
    const double rootB = roots[spring.b];
    double longer = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      longer += spring.along[i] * (rootB * moved[spring.b][i] - rootA * moved[spring.a][i]);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      result[spring.a][i] -= rootA * longer * spring.along[i];
      result[spring.b][i] += rootB * longer * spring.along[i];
    }
  }
  return result;
}

}  // namespace

double stableStiffness(const btSoftBody& body, double substep) {
  Vectors moved(static_cast<std::size_t>(body.m_nodes.size()));
  std::minstd_rand random;  // the same numbers in each run and library
  for (auto& vector : moved) {
    for (double& x : vector) x = static_cast<double>(random()) / std::minstd_rand::max() - 0.5;
  }
  scaledToOne(moved);
  const std::vector<Spring> springs = springsAlongLinks(body);
  const std::vector<double> roots = rootsOf(body);
  double eigenvalue = 0;
  for (int round = 0; round < rounds; ++round) {
    moved = pulled(springs, roots, moved);
    eigenvalue = scaledToOne(moved);
  }
  if (!(eigenvalue > 0)) return std::numeric_limits<double>::infinity();
  return squaredPhase / (eigenvalue * substep * substep);
}

DeformableSprings springsOf(const SpringScene& scene, const btSoftBody& body, double substep, bool isImplicit) {
  const bool isAllSaid = scene.stiffness && scene.bendingStiffness;
  const double most =
      isAllSaid || isImplicit ? std::numeric_limits<double>::infinity() : stableStiffness(body, substep);
  DeformableSprings springs;
  springs.stiffness = scene.stiffness.value_or(std::min(stiffest, most));
  springs.bendingStiffness = scene.bendingStiffness.value_or(std::min(stiffestBending, most));
  springs.damping = scene.damping;
  return springs;
}

}  // namespace command
