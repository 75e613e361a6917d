// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/ClothGuard.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/numerics/BestLanes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr double kThicknessOfEdge = 0.5;  // of the mean edge, at most: neighbours are not to push each other
// How far nodes may leave the way that is expected of them: by a share of it, within shares of the mean edge.
constexpr btScalar kSlackOfWay = btScalar(0.1);
constexpr btScalar kLeastSlackOfEdge = btScalar(0.01);
constexpr btScalar kMostSlackOfEdge = btScalar(0.05);
constexpr btScalar kMostSlackFactor = 64;  // when what was held apart left what had been expected of it
constexpr btScalar kRoundingsOfSlack = 200;
constexpr btScalar kPartingOfSlack = btScalar(0.1);  // in a small step
constexpr btScalar kUsedSlack = btScalar(0.9);       // the rest is for rounding
constexpr int kMostLooks = 6;                        // in a small step

// Of a number near 1. In float64 more than double rounds, in which gaps near it are computed.
constexpr btScalar kRoundingAtOne = std::max(std::numeric_limits<btScalar>::epsilon(), btScalar(1e-12));

// Whether all places along one axis are where they were expected.
struct OnTheWay {
  const btScalar* place;
  const btScalar* from;
  const btScalar* way;
  std::size_t count;
  btScalar age;
  btScalar slack;
  bool& isOnIt;

  template <class Lanes>
  WETCLOTH_INLINE void run() const {
    Lanes farthest = everywhere<Lanes>(0);
    for (std::size_t i = 0; i < count; i += kLaneCount<Lanes>) {
      const Lanes off =
          load<Lanes>(place + i) - (load<Lanes>(from + i) + load<Lanes>(way + i) * everywhere<Lanes>(age));
      const Lanes away = absolute(off);
      farthest = choose(away > farthest, away, farthest);
    }
    btScalar parts[kLaneCount<Lanes>];
    store(parts, farthest);
    for (const btScalar part : parts) isOnIt = isOnIt && part <= slack;
  }
};

// What leads from one place to the next, along one axis.
struct Difference {
  const btScalar* to;
  const btScalar* from;
  btScalar* way;
  std::size_t count;

  template <class Lanes>
  WETCLOTH_INLINE void run() const {
    for (std::size_t i = 0; i < count; i += kLaneCount<Lanes>) {
      store(way + i, load<Lanes>(to + i) - load<Lanes>(from + i));
    }
  }
};

}  // namespace

void ClothGuard::begin(const std::vector<Cloth>& cloths, const ClothSolver::Guard& parameters,
                       const GuardExemptions* exemptions) {
  m_cloths = cloths;
  m_parameters = parameters;
  m_exemptions = exemptions;
  m_kept.resize(cloths.size());
  m_first.clear();
  m_tiles.clear();
  std::size_t count = 0;
  double edge = std::numeric_limits<double>::infinity();
  for (const Cloth& cloth : cloths) {
    m_first.push_back(count);
    m_tiles.add(*cloth.mesh, count);
    count += toSize(cloth.nodeCount);
    if (cloth.mesh->edgeLength > 0) edge = std::min(edge, cloth.mesh->edgeLength);
  }
  m_nodes.resize(count);
  m_nodes.setBodies(cloths.back().mesh->isOfBodies ? m_first.back() : count);
  m_edge = static_cast<btScalar>(edge);
  m_contact.thickness = static_cast<btScalar>(std::min(parameters.thickness, kThicknessOfEdge * edge));
  m_contact.friction = static_cast<btScalar>(parameters.friction);
  keep();
  btScalar farthest = 0;
  for (const Cloth& cloth : cloths) {
    const btVector3 away = cloth.origin - cloths.front().origin;
    for (int axis = 0; axis < 3; ++axis) {
      for (std::size_t i = 0; i < cloth.nodes.count; ++i) {
        farthest = std::max(farthest, std::fabs(cloth.nodes.position[axis][i] + away[axis]));
      }
    }
  }
  m_rounding = farthest * kRoundingAtOne;
  m_contact.rounding = m_rounding;
  m_pairs.clear();
  m_ahead = parameters.every;
  m_isFirst = true;
  m_age = m_ahead;  // to be looked at
}

void ClothGuard::keep() {
  for (std::size_t c = 0; c < m_cloths.size(); ++c) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const btScalar* const places = m_cloths[c].nodes.position[axis];
      m_kept[c].before[axis].swap(m_kept[c].last[axis]);
      m_kept[c].last[axis].assign(places, places + m_cloths[c].nodes.count);
    }
  }
}

// Nodes that are held back want to go far in each small step, and do not: they are expected to go on as they did. In
// the first small step it is not known how they do.
void ClothGuard::hold() {
  if (m_age >= m_ahead) {
    m_ahead = std::min(2 * m_ahead, m_parameters.every);
    m_isFirst ? lookAlongPresentWays() : lookAlongLastWays();
    m_isFirst = false;
  } else {
    ++m_age;
  }
  forgetAside();
  if (!m_pairs.isEmpty()) {
    gather();
    m_pairs.part(m_nodes);
    scatter();
  }
  bool isHeld = false;
  for (int k = 0; k < kMostLooks; ++k) {
    enforce();
    isHeld = isWhereExpected() && m_pairs.settle(m_nodes);
    if (isHeld) break;
    m_ahead = k == 0 ? std::max(1, std::min(m_ahead, m_age) / 2) : 1;
    m_slackFactor = std::min(2 * m_slackFactor, kMostSlackFactor);
    lookAlongPresentWays();
    gather();
    isHeld = m_pairs.settle(m_nodes);  // where nodes are is what is expected now
    if (isHeld) break;
  }
  m_slackFactor = 1;
  isHeld ? keepAside() : stopAll();
  keep();
}

void ClothGuard::enforce() {
  if (m_pairs.isEmpty()) return;
  gather();
  const GuardPairs::Outcome outcome = m_pairs.enforce(m_nodes);
  scatter();
  m_totals.stopped += outcome.stopped;
  m_totals.forced += outcome.forced;
}

void ClothGuard::forgetAside() {
  for (GuardNodes::Place& aside : m_nodes.aside) aside = {};
  for (GuardNodes::Place& recoil : m_nodes.recoil) recoil = {};
}

// What moved nodes aside has changed where they would be without links and contacts, and so no velocity.
void ClothGuard::keepAside() {
  if (m_pairs.isEmpty()) return;
  for (std::size_t c = 0; c < m_cloths.size(); ++c) {
    const Cloth& cloth = m_cloths[c];
    for (int node = 0; node < cloth.nodeCount; ++node) {
      const std::size_t slot = toSize(cloth.slots[node]);
      const GuardNodes::Place& aside = m_nodes.aside[m_first[c] + toSize(node)];
      for (std::size_t axis = 0; axis < 3; ++axis) cloth.nodes.predicted[axis][slot] += aside.at[axis];
    }
  }
}

void ClothGuard::stopAll() {
  ++m_totals.halts;
  for (std::size_t c = 0; c < m_cloths.size(); ++c) {
    const MovingNodes& nodes = m_cloths[c].nodes;
    for (std::size_t i = 0; i < nodes.count; ++i) {
      if (!(nodes.inverseMass[i] > 0)) continue;
      for (std::size_t axis = 0; axis < 3; ++axis) nodes.position[axis][i] = m_kept[c].last[axis][i];
    }
  }
  lookAlongPresentWays();
  gather();
  if (m_pairs.settle(m_nodes)) return;
  m_totals.forced += m_pairs.release(m_nodes);
  m_pairs.settle(m_nodes);
}

bool ClothGuard::isWhereExpected() const {
  bool isOnIt = true;
  for (std::size_t c = 0; c < m_cloths.size() && isOnIt; ++c) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      runOnBestLanes(OnTheWay{m_cloths[c].nodes.position[axis], m_kept[c].from[axis].data(), m_kept[c].way[axis].data(),
                              m_cloths[c].nodes.count, static_cast<btScalar>(m_age), m_slack * kUsedSlack, isOnIt});
    }
  }
  return isOnIt;
}

void ClothGuard::lookAlongPresentWays() {
  for (std::size_t c = 0; c < m_cloths.size(); ++c) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      m_kept[c].setWay(axis, m_cloths[c].nodes.position[axis], m_kept[c].last[axis].data());
    }
  }
  look();
}

void ClothGuard::lookAlongLastWays() {
  for (Kept& kept : m_kept) {
    for (std::size_t axis = 0; axis < 3; ++axis) kept.setWay(axis, kept.last[axis].data(), kept.before[axis].data());
  }
  look();
}

void ClothGuard::Kept::setWay(std::size_t axis, const btScalar* to, const btScalar* start) {
  from[axis] = last[axis];
  way[axis].resize(last[axis].size());
  runOnBestLanes(Difference{to, start, way[axis].data(), way[axis].size()});
}

void ClothGuard::look() {
  ++m_totals.looks;
  m_age = 1;
  btScalar longest = 0;
  for (std::size_t c = 0; c < m_cloths.size(); ++c) {
    const Cloth& cloth = m_cloths[c];
    const btVector3 away = cloth.origin - m_cloths.front().origin;
    for (int node = 0; node < cloth.nodeCount; ++node) {
      const std::size_t i = m_first[c] + toSize(node);
      const std::size_t slot = toSize(cloth.slots[node]);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const btScalar way = m_kept[c].way[axis][slot];
        m_nodes.from[i].at[axis] = m_kept[c].from[axis][slot] + away[static_cast<int>(axis)];
        m_nodes.to[i].at[axis] = m_nodes.from[i].at[axis] + way;
        longest = std::max(longest, std::fabs(way));
      }
    }
  }
  m_slack = std::min(std::max(kSlackOfWay * static_cast<btScalar>(m_ahead) * longest, kLeastSlackOfEdge * m_edge),
                     kMostSlackOfEdge * m_edge);
  m_slack = std::min(m_slackFactor * m_slack, kMostSlackOfEdge * m_edge * std::max(btScalar(1), m_slackFactor / 16));
  m_slack = std::max(m_slack, kRoundingsOfSlack * m_rounding);
  m_candidates.clear();
  m_contact.mostParting = kPartingOfSlack * m_slack;
  const GuardTiles::Expectation expectation = {m_ahead, m_slack, m_contact.thickness};
  m_tiles.findPairs(m_nodes, expectation, {m_parameters.self, m_parameters.others}, m_candidates);
  if (m_exemptions) m_exemptions->takeFrom(m_candidates);
  m_totals.candidates += static_cast<long long>(m_candidates.size());
  m_totals.meeting = std::max(m_totals.meeting, m_pairs.look(m_nodes, m_candidates, expectation, m_contact));
  m_totals.pairs += static_cast<long long>(m_pairs.size());
}

void ClothGuard::gather() {
  for (std::size_t c = 0; c < m_cloths.size(); ++c) {
    const Cloth& cloth = m_cloths[c];
    const btVector3 away = cloth.origin - m_cloths.front().origin;
    for (int node = 0; node < cloth.nodeCount; ++node) {
      const std::size_t i = m_first[c] + toSize(node);
      const std::size_t slot = toSize(cloth.slots[node]);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        m_nodes.from[i].at[axis] = m_kept[c].last[axis][slot] + away[static_cast<int>(axis)];
        m_nodes.to[i].at[axis] = cloth.nodes.position[axis][slot] + away[static_cast<int>(axis)];
      }
      m_nodes.inverseMass[i] = cloth.nodes.inverseMass[slot];
    }
  }
}

void ClothGuard::scatter() {
  for (std::size_t c = 0; c < m_cloths.size(); ++c) {
    const Cloth& cloth = m_cloths[c];
    const btVector3 away = cloth.origin - m_cloths.front().origin;
    for (int node = 0; node < cloth.nodeCount; ++node) {
      const std::size_t slot = toSize(cloth.slots[node]);
      if (!(cloth.nodes.inverseMass[slot] > 0)) continue;
      for (int axis = 0; axis < 3; ++axis) {
        cloth.nodes.position[axis][slot] = m_nodes.to[m_first[c] + toSize(node)].at[axis] - away[axis];
      }
    }
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
