// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/ClothGuard.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/numerics/BestLanes.h"
#include "bullet_wetcloth/solver/CrossingExemptions.h"
#include "bullet_wetcloth/solver/ExpectedPlaces.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr btScalar kTouching = btScalar(17.0 / 16);  // of the thickness
constexpr double kThicknessOfEdge = 0.5;             // of the mean edge, at most: neighbours are not to push each other
// How far nodes may leave the way that is expected of them, on each axis: shares of the mean edge, of the way ahead,
// and of what their present acceleration does in one small step and in those ahead.
constexpr btScalar kLeastSlackOfEdge = btScalar(0.01);
constexpr btScalar kLeastSlackByNodes = btScalar(0.04);  // where there is no grid
constexpr btScalar kMostSlackOfEdge = btScalar(0.1);
constexpr btScalar kSlackOfWay = btScalar(0.02);
constexpr btScalar kSlackOfAcceleration = 1;
constexpr btScalar kSlackOfBend = btScalar(0.2);       // a parabola is 1/8 of it from its chord
constexpr btScalar kMostBendOfEdge = btScalar(0.1);    // by which an end is expected off the present way
constexpr btScalar kMostJoltOfEdge = btScalar(0.005);  // that is taken to go on, where there is no grid
constexpr btScalar kMostSlackFactor = 64;              // when what was held apart left what had been expected of it
constexpr int kFewAhead = 2;                           // small steps
// Share of nodes that may need more than the most slack: where there is a grid, and where each is looked at again by
// itself.
constexpr double kRestless = 0.001;
constexpr double kRestlessByNodes = 0.03;
constexpr btScalar kRoundingsOfSlack = 200;
constexpr btScalar kPartingOfEdge = btScalar(0.001);  // in a small step
constexpr int kMostLooks = 12;                        // in a small step

// Of a number near 1. In float64 more than double rounds, in which gaps near it are computed.
constexpr btScalar kRoundingAtOne = std::max(std::numeric_limits<btScalar>::epsilon(), btScalar(1e-12));

}  // namespace

void ClothGuard::begin(const std::vector<Cloth>& cloths, const ClothSolver::Guard& parameters, int smallSteps,
                       const GuardExemptions* exemptions, const CrossingExemptions* crossings) {
  beginStops(cloths);
  m_cloths = cloths;
  m_parameters = parameters;
  m_exemptions = exemptions;
  m_crossings = crossings;
  m_kept.resize(cloths.size());
  m_first.clear();
  m_coincident.clear();
  m_tiles.clear();
  std::size_t count = 0;
  double edge = std::numeric_limits<double>::infinity();
  for (const Cloth& cloth : cloths) {
    m_first.push_back(count);
    m_coincident.add(toSize(cloth.nodeCount), cloth.coincident);
    m_tiles.add(*cloth.mesh, count, cloth.isStill || cloth.mesh->isOfBodies);
    count += toSize(cloth.nodeCount);
    if (cloth.mesh->edgeLength > 0) edge = std::min(edge, cloth.mesh->edgeLength);
  }
  if (std::isinf(edge)) edge = 0;  // all faces are points
  m_nodes.resize(count);
  m_nodes.setBodies(cloths.back().mesh->isOfBodies ? m_first.back() : count);
  m_edge = static_cast<btScalar>(edge);
  m_contact.thickness = static_cast<btScalar>(std::min(parameters.thickness, kThicknessOfEdge * edge));
  m_contact.touching = kTouching * m_contact.thickness;
  m_contact.mostParting = kPartingOfEdge * m_edge;
  m_contact.friction = static_cast<btScalar>(parameters.friction);
  for (std::size_t c = 0; c < cloths.size(); ++c) {
    const MovingNodes& nodes = cloths[c].nodes;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      m_kept[c].last[axis].assign(nodes.position[axis], nodes.position[axis] + nodes.count);
      m_kept[c].before[axis].resize(nodes.count);
      const btScalar* const settled = cloths[c].settled[axis];
      runOnBestLanes(PlacesBefore{nodes.position[axis], settled ? settled : nodes.velocity[axis], cloths[c].h,
                                  m_kept[c].before[axis].data(), nodes.count});
    }
  }
  btScalar farthest = 0;
  for (const Cloth& cloth : cloths) {
    const btVector3 away = cloth.origin - cloths.front().origin;
    for (int axis = 0; axis < 3; ++axis) {
      runOnBestLanes(FarthestPlace{cloth.nodes.position[axis], cloth.nodes.count, away[axis], farthest});
    }
  }
  m_rounding = farthest * kRoundingAtOne;
  m_contact.rounding = m_rounding;
  m_isAnyGrid = std::any_of(cloths.begin(), cloths.end(), [](const Cloth& cloth) { return cloth.mesh->isGrid(); });
  const btScalar least = m_isAnyGrid ? kLeastSlackOfEdge : kLeastSlackByNodes;
  m_leastSlack = std::max(least * m_edge, kRoundingsOfSlack * m_rounding);
  m_mostSlack = std::max(kMostSlackOfEdge * m_edge, m_leastSlack);
  takeWetness();
  m_pairs.clear();
  m_smallSteps = smallSteps;
  m_taken = 0;
  m_age = m_ahead = 0;  // to be looked at
  forgetAside();
}

// What is begun again in the middle of a step goes on with it.
void ClothGuard::beginStops(const std::vector<Cloth>& cloths) {
  std::size_t count = 0;
  bool areSame = true;
  for (std::size_t c = 0; c < cloths.size() && !cloths[c].mesh->isOfBodies; ++c) {
    count += toSize(cloths[c].nodeCount);
    areSame = areSame && c < m_cloths.size() && m_cloths[c].mesh == cloths[c].mesh && !cloths[c].isNew;
  }
  if (!areSame || m_taken >= m_smallSteps) m_stops.begin(count, areSame);
}

void ClothGuard::takeWetness() {
  m_nodes.friction.clear();
  m_pairs.cling().begin(m_nodes.to.size());
  for (std::size_t c = 0; c < m_cloths.size(); ++c) {
    const LayerWetness* const wetness = m_cloths[c].wetness;
    const std::size_t count = toSize(m_cloths[c].nodeCount);
    if (!wetness) continue;
    m_pairs.cling().add(m_first[c], count, *wetness, m_cloths[c].h);
    if (wetness->friction.size() != count) continue;
    m_nodes.startFriction();
    std::copy(wetness->friction.begin(), wetness->friction.end(),
              m_nodes.friction.begin() + static_cast<std::ptrdiff_t>(m_first[c]));
  }
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

void ClothGuard::hold() {
  for (GuardNodes::Place& recoil : m_nodes.recoil) recoil = {};
  m_pairs.cling().renew();
  m_age >= m_ahead ? look() : static_cast<void>(++m_age);
  if (!m_pairs.isEmpty()) {
    gatherToMove();
    m_pairs.part(m_nodes);
    scatter();
  }
  bool isHeld = false;
  for (int k = 0; k < kMostLooks && !isHeld; ++k) {
    enforce();
    isHeld = isWhereExpected() && m_pairs.settle(m_nodes);
    if (isHeld) break;
    isWhereExpected() ? look() : lookAgain();
    isHeld = m_pairs.settle(m_nodes);  // where nodes are is what is expected now
    m_slackFactor = std::min(2 * m_slackFactor, kMostSlackFactor);
  }
  m_slackFactor = 1;
  isHeld ? keepAside() : stopAll();
  m_stops.endSmallStep(m_cloths.front().h, m_nodes, m_cloths.front().origin);
  keep();
  ++m_taken;
}

void ClothGuard::enforce() {
  if (m_pairs.isEmpty()) return;
  gatherToMove();
  const GuardPairs::Outcome outcome = m_pairs.enforce(m_nodes);
  scatter();
  m_totals.stopped += outcome.stopped;
  m_stops.add(m_pairs.slowed());
  m_totals.forced += outcome.forced;
}

// What parts the nodes that are held is aside, until the end of the small step.
void ClothGuard::gatherToMove() {
  gather();
  m_areAllAside = m_areAllAside || m_areAllHeld;
  m_aside.insert(m_aside.end(), m_held.begin(), m_held.end());
}

template <class Action>
void ClothGuard::forEachAside(const Action& action) {
  if (m_areAllAside) {
    forEachNode([&](std::size_t c, int node) { action(c, node); });
  } else {
    for (const int node : m_aside) {
      const std::size_t c = clothOf(node);
      action(c, node - static_cast<int>(m_first[c]));
    }
  }
  m_areAllAside = false;
  m_aside.clear();
}

void ClothGuard::forgetAside() {
  forEachAside([this](std::size_t c, int node) { m_nodes.aside[m_first[c] + toSize(node)] = {}; });
}

// What moved nodes aside has changed where they would be without links and contacts, and so no velocity.
void ClothGuard::keepAside() {
  forEachAside([this](std::size_t c, int node) {
    const Cloth& cloth = m_cloths[c];
    const std::size_t slot = toSize(cloth.slots[node]);
    GuardNodes::Place& aside = m_nodes.aside[m_first[c] + toSize(node)];
    for (std::size_t axis = 0; axis < 3; ++axis) cloth.nodes.predicted[axis][slot] += aside.at[axis];
    aside = {};  // a node may come again
  });
}

void ClothGuard::stopAll() {
  forgetAside();
  ++m_totals.halts;
  for (std::size_t c = 0; c < m_cloths.size(); ++c) {
    const MovingNodes& nodes = m_cloths[c].nodes;
    for (std::size_t i = 0; i < nodes.count; ++i) {
      if (!(nodes.inverseMass[i] > 0)) continue;
      for (std::size_t axis = 0; axis < 3; ++axis) nodes.position[axis][i] = m_kept[c].last[axis][i];
    }
  }
  look();
  forEachNode([this](std::size_t c, int node) { gather(c, node); });
  m_stops.addAll(m_nodes);
  if (m_pairs.settle(m_nodes)) return;
  m_totals.forced += m_pairs.release(m_nodes);
  m_pairs.settle(m_nodes);
}

bool ClothGuard::isWhereExpected() const {
  bool areFound = true;
  for (std::size_t c = 0; c < m_cloths.size() && areFound; ++c) {
    const Kept& kept = m_kept[c];
    const MovingNodes& nodes = m_cloths[c].nodes;
    runOnBestLanes(AreAllFound{
        {nodes.position, kept.from, kept.way, kept.slack.data(), nodes.count, static_cast<btScalar>(m_age)}, areFound});
  }
  return areFound;
}

// From the present small step on, for so many.
WaySlack ClothGuard::slackFor(int steps) const {
  const btScalar count = static_cast<btScalar>(steps);
  return {m_slackFactor * m_leastSlack,
          m_slackFactor * m_mostSlack,
          kSlackOfWay * count,
          kSlackOfAcceleration + (m_isAnyGrid ? kSlackOfBend * count * count : 0),
          kMostBendOfEdge * m_edge / count,
          m_isAnyGrid ? -1 : kMostJoltOfEdge * m_edge};
}

// Where there is no grid that of bodies is for rounding: they go straight.
WaySlack ClothGuard::slackOfCloth(std::size_t c) const {
  WaySlack slack = slackFor(m_ahead);
  if (m_isAnyGrid || !m_cloths[c].mesh->isOfBodies) return slack;
  slack.least = m_slackFactor * kRoundingsOfSlack * m_rounding;
  slack.ofWay = 0;
  return slack;
}

// All nodes, from now on. What moves restlessly is not expected far ahead.
void ClothGuard::look() {
  ++m_totals.looks;
  m_age = 1;
  m_ahead = std::min(m_parameters.every, m_smallSteps - m_taken);
  const double restless = m_isAnyGrid ? kRestless : kRestlessByNodes;
  while (expectAll() > restless && m_ahead > kFewAhead) m_ahead /= 2;
  for (std::size_t c = 0; c < m_cloths.size(); ++c) showExpected(c);
  m_pairs.clear();
  m_candidates.clear();
  m_tiles.findPairs(m_nodes, m_contact.thickness, {m_parameters.self, m_parameters.others}, m_candidates);
  addPlanes();
}

// Returns the share of restless nodes: they may need more than the most slack.
double ClothGuard::expectAll() {
  double restless = 0;
  double all = 0;
  for (std::size_t c = 0; c < m_cloths.size(); ++c) {
    Kept& kept = m_kept[c];
    const MovingNodes& nodes = m_cloths[c].nodes;
    kept.slack.resize(nodes.count);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      kept.from[axis].resize(nodes.count);
      kept.way[axis].resize(nodes.count);
    }
    runOnBestLanes(ExpectWays{nodes.position, kept.last, kept.before, kept.from, kept.way, kept.slack.data(),
                              nodes.count, static_cast<btScalar>(m_ahead), slackOfCloth(c), restless});
    all += static_cast<double>(nodes.count);
  }
  return restless / all;
}

// The nodes that have left their way are expected on the one that they take now.
void ClothGuard::lookAgain() {
  ++m_totals.looks;
  m_left.clear();
  for (std::size_t c = 0; c < m_cloths.size(); ++c) {
    const Kept& kept = m_kept[c];
    const Cloth& cloth = m_cloths[c];
    m_isFound.resize(cloth.nodes.count);
    runOnBestLanes(MarkFound{
        {cloth.nodes.position, kept.from, kept.way, kept.slack.data(), cloth.nodes.count, static_cast<btScalar>(m_age)},
        m_isFound.data()});
    for (int node = 0; node < cloth.nodeCount; ++node) {
      if (m_isFound[toSize(cloth.slots[node])] > 0) continue;
      expectOnPresentWay(c, node);
      m_left.push_back(static_cast<int>(m_first[c]) + node);
    }
  }
  m_candidates.clear();
  m_tiles.findPairsAgain(m_left, m_candidates);
  m_pairs.drop([&](const GuardPair& pair) { return m_tiles.isLookedAtAgain(pair); });
  addPlanes();
}

void ClothGuard::addPlanes() {
  if (m_exemptions) m_exemptions->takeFrom(m_candidates);
  if (m_crossings) m_crossings->takeFrom(m_candidates);
  m_coincident.takeFrom(m_candidates);
  m_totals.candidates += static_cast<long long>(m_candidates.size());
  gather(m_candidates);
  m_totals.meeting = std::max(m_totals.meeting, m_pairs.look(m_nodes, m_candidates, m_contact));
  m_totals.pairs += static_cast<long long>(m_pairs.size());
  findHeld();
}

void ClothGuard::expectOnPresentWay(std::size_t c, int node) {
  Kept& kept = m_kept[c];
  const std::size_t slot = toSize(m_cloths[c].slots[node]);
  const int steps = m_ahead - m_age + 1;
  const WaySlack slackOf = slackFor(steps);
  btScalar slack = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const btScalar last = kept.last[axis][slot];
    const btScalar now = m_cloths[c].nodes.position[axis][slot] - last;
    const btScalar earlier = last - kept.before[axis][slot];
    const btScalar acceleration = now - earlier;
    kept.way[axis][slot] = slackOf.ahead(now, earlier, static_cast<btScalar>(steps));
    kept.from[axis][slot] = last - kept.way[axis][slot] * static_cast<btScalar>(m_age - 1);
    slack = std::max(slack, slackOf.of(now, acceleration));
  }
  kept.slack[slot] = slack;
  showExpected(c, node);
}

// To those who find pairs: of all nodes, at a look.
void ClothGuard::showExpected(std::size_t c) {
  const Cloth& cloth = m_cloths[c];
  const Kept& kept = m_kept[c];
  if (!cloth.nodeOfSlot) {
    for (int node = 0; node < cloth.nodeCount; ++node) showExpected(c, node);
    return;
  }
  const btVector3 away = cloth.origin - m_cloths.front().origin;
  const Quad steps = everywhere<Quad>(static_cast<btScalar>(m_ahead));
  GuardNodes::Way* const ways = &m_nodes.expected[m_first[c]];
  for (std::size_t slot = 0; slot < cloth.nodes.count; slot += 4) {
    Quad starts[4], ends[4], start[4], end[4];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      starts[axis] = load<Quad>(&kept.from[axis][slot]) + everywhere<Quad>(away[static_cast<int>(axis)]);
      ends[axis] = starts[axis] + load<Quad>(&kept.way[axis][slot]) * steps;
    }
    starts[3] = ends[3] = load<Quad>(&kept.slack[slot]);
    transpose(starts, start);
    transpose(ends, end);
    for (std::size_t k = 0; k < 4; ++k) {
      const int node = cloth.nodeOfSlot[slot + k];
      if (node < 0) continue;
      store(ways[node].start.at, start[k]);
      store(ways[node].end.at, end[k]);
    }
  }
}

// From the last look at all nodes on, also of what has left its way since then. What they say
// of two nodes is between what it is at the start and at the end only where both start at one time.
void ClothGuard::showExpected(std::size_t c, int node) {
  const Cloth& cloth = m_cloths[c];
  const Kept& kept = m_kept[c];
  const btVector3 away = cloth.origin - m_cloths.front().origin;
  const std::size_t slot = toSize(cloth.slots[node]);
  auto& [start, end] = m_nodes.expected[m_first[c] + toSize(node)];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    start.at[axis] = kept.from[axis][slot] + away[static_cast<int>(axis)];
    end.at[axis] = start.at[axis] + kept.way[axis][slot] * static_cast<btScalar>(m_ahead);
  }
  start.at[3] = end.at[3] = kept.slack[slot];
}

// Whose places the pairs see and change.
void ClothGuard::findHeld() {
  m_held.clear();
  m_areAllHeld = 4 * m_pairs.size() > m_nodes.to.size();
  if (m_areAllHeld) return;
  m_pairs.forEachNode([this](int node) { m_held.push_back(node); });
  std::sort(m_held.begin(), m_held.end());
  m_held.erase(std::unique(m_held.begin(), m_held.end()), m_held.end());
}

template <class Action>
void ClothGuard::forEachHeld(const Action& action) const {
  if (m_areAllHeld) return forEachNode(action);
  std::size_t c = 0;
  for (const int node : m_held) {
    while (c + 1 < m_first.size() && m_first[c + 1] <= toSize(node)) ++c;
    action(c, node - static_cast<int>(m_first[c]));
  }
}

template <class Action>
void ClothGuard::forEachNode(const Action& action) const {
  for (std::size_t c = 0; c < m_cloths.size(); ++c) {
    for (int node = 0; node < m_cloths[c].nodeCount; ++node) action(c, node);
  }
}

void ClothGuard::gather() {
  if (m_areAllHeld) return gatherAll();
  forEachHeld([this](std::size_t c, int node) { gather(c, node); });
}

std::size_t ClothGuard::clothOf(int node) const {
  const auto next = std::upper_bound(m_first.begin(), m_first.end(), toSize(node));
  return static_cast<std::size_t>(next - m_first.begin()) - 1;
}

// The nodes of these pairs, if that is less.
void ClothGuard::gather(const GuardCandidates& pairs) {
  if (4 * pairs.size() > m_nodes.to.size()) return gatherAll();
  for (const std::vector<GuardPair>* const some : {&pairs.vertexFace, &pairs.edgeEdge}) {
    for (const GuardPair& pair : *some) {
      for (const int node : pair.node) {
        const std::size_t c = clothOf(node);
        gather(c, node - static_cast<int>(m_first[c]));
      }
    }
  }
}

void ClothGuard::gatherAll() {
  for (std::size_t c = 0; c < m_cloths.size(); ++c) gatherAll(c);
}

void ClothGuard::gatherAll(std::size_t c) {
  const Cloth& cloth = m_cloths[c];
  if (!cloth.nodeOfSlot) {
    for (int node = 0; node < cloth.nodeCount; ++node) gather(c, node);
    return;
  }
  const btVector3 away = cloth.origin - m_cloths.front().origin;
  for (std::size_t slot = 0; slot < cloth.nodes.count; slot += 4) {
    Quad before[4] = {everywhere<Quad>(0), everywhere<Quad>(0), everywhere<Quad>(0), everywhere<Quad>(0)};
    Quad now[4] = {before[0], before[0], before[0], before[0]};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      before[axis] = load<Quad>(&m_kept[c].last[axis][slot]) + everywhere<Quad>(away[static_cast<int>(axis)]);
      now[axis] = load<Quad>(&cloth.nodes.position[axis][slot]) + everywhere<Quad>(away[static_cast<int>(axis)]);
    }
    Quad from[4], to[4];
    transpose(before, from);
    transpose(now, to);
    for (std::size_t k = 0; k < 4; ++k) {
      if (cloth.nodeOfSlot[slot + k] < 0) continue;
      const std::size_t i = m_first[c] + toSize(cloth.nodeOfSlot[slot + k]);
      store(m_nodes.from[i].at, from[k]);
      store(m_nodes.to[i].at, to[k]);
      m_nodes.inverseMass[i] = cloth.isStill ? 0 : cloth.nodes.inverseMass[slot + k];
    }
  }
}

void ClothGuard::gather(std::size_t c, int node) {
  const Cloth& cloth = m_cloths[c];
  const btVector3 away = cloth.origin - m_cloths.front().origin;
  const std::size_t i = m_first[c] + toSize(node);
  const std::size_t slot = toSize(cloth.slots[node]);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    m_nodes.from[i].at[axis] = m_kept[c].last[axis][slot] + away[static_cast<int>(axis)];
    m_nodes.to[i].at[axis] = cloth.nodes.position[axis][slot] + away[static_cast<int>(axis)];
  }
  m_nodes.inverseMass[i] = cloth.isStill ? 0 : cloth.nodes.inverseMass[slot];
}

void ClothGuard::scatter() {
  forEachHeld([this](std::size_t c, int node) {
    const Cloth& cloth = m_cloths[c];
    const std::size_t slot = toSize(cloth.slots[node]);
    if (cloth.isStill || !(cloth.nodes.inverseMass[slot] > 0)) return;
    const btVector3 away = cloth.origin - m_cloths.front().origin;
    for (int axis = 0; axis < 3; ++axis) {
      cloth.nodes.position[axis][slot] = m_nodes.to[m_first[c] + toSize(node)].at[axis] - away[axis];
    }
  });
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
