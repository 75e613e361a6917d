// SPDX-License-Identifier: Zlib
#include "command/scene/StableSprings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <random>
#include <stdexcept>

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

double lightestFreeNode(const btSoftBody& body) {
  double most = 0;
  for (int i = 0; i < body.m_nodes.size(); ++i) most = std::max(most, static_cast<double>(body.m_nodes[i].m_im));
  return 1 / most;
}

/// What a spring does to a node in a substep, times this precision's rounding, must be less than the node's own mass;
/// else the mass is lost in a sum of the two, and Bullet's solver leaves the cloth hanging in the air.
void requireMassesToCount(const char* key, double value, double most) {
  if (value < most) return;
  char text[200];
  std::snprintf(text, sizeof text,
                "\"%s\" = %g: must be less than %.3g, where the lightest node's mass is lost beside it; try smaller "
                "substeps or the effect hooke_springs",
                key, value, most);
  throw std::invalid_argument(text);
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
  const double stable =
      isAllSaid || isImplicit ? std::numeric_limits<double>::infinity() : stableStiffness(body, substep);
  DeformableSprings springs;
  springs.stiffness = scene.stiffness.value_or(std::min(stiffest, stable));
  springs.bendingStiffness = scene.bendingStiffness.value_or(std::min(stiffestBending, stable));
  springs.damping = scene.damping;
  const double most = lightestFreeNode(body) / static_cast<double>(std::numeric_limits<btScalar>::epsilon());
  requireMassesToCount("spring_stiffness_n_m", springs.stiffness, most / (substep * substep));
  requireMassesToCount("bending_stiffness_n_m", springs.bendingStiffness, most / (substep * substep));
  requireMassesToCount("spring_damping_n_s_m", springs.damping, most / substep);
  return springs;
}

}  // namespace command
