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

/// M^-1/2 K M^-1/2 of springs of 1 N/m along the links.
Vectors pulled(const btSoftBody& body, const Vectors& moved) {
  Vectors result(moved.size(), {0, 0, 0});
  for (int k = 0; k < body.m_links.size(); ++k) {
    const btSoftBody::Link& link = body.m_links[k];
    const btVector3 along = (link.m_n[1]->m_x - link.m_n[0]->m_x).normalized();
    const auto a = static_cast<std::size_t>(link.m_n[0] - &body.m_nodes[0]);
    const auto b = static_cast<std::size_t>(link.m_n[1] - &body.m_nodes[0]);
    const double rootA = std::sqrt(static_cast<double>(link.m_n[0]->m_im));
    const double rootB = std::sqrt(static_cast<double>(link.m_n[1]->m_im));
    double longer = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      longer += static_cast<double>(along[axis]) * (rootB * moved[b][i] - rootA * moved[a][i]);
    }
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      result[a][i] -= rootA * longer * static_cast<double>(along[axis]);
      result[b][i] += rootB * longer * static_cast<double>(along[axis]);
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
  double eigenvalue = 0;
  for (int round = 0; round < rounds; ++round) {
    moved = pulled(body, moved);
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
