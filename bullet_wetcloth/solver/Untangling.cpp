// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/Untangling.h"

#include "bullet_wetcloth/bullet/Index.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr btScalar kSpeed = btScalar(0.5);       // with which crossing parts are drawn apart [m/s]
constexpr btScalar kMostOfEdge = btScalar(0.1);  // of a mean edge, in a small step
constexpr btScalar kMostGradient = 4;  // of one crossing: an edge that lies nearly in a face is not to have all the say

// From one place to another.
btVector3 wayTo(const BodyPoint& from, const BodyPoint& to) {
  return btVector3(static_cast<btScalar>(to[0] - from[0]), static_cast<btScalar>(to[1] - from[1]),
                   static_cast<btScalar>(to[2] - from[2]));
}

// Or nothing, of what has no length.
btVector3 unit(const btVector3& vector) {
  const btScalar length = vector.length();
  return length > 0 ? vector / length : btVector3(0, 0, 0);
}

// Along the curve where a face crosses another one, from the edge into the face.
// @param normal  of the other face
btVector3 intoFace(const btVector3& edge, const btVector3& toThird, const btVector3& normal) {
  const btVector3 along = unit(edge.cross(toThird).cross(normal));
  const btVector3 inward = toThird - edge * edge.dot(toThird);
  return along.dot(inward) < 0 ? -along : along;
}

}  // namespace

void Untangling::begin(const std::vector<Crossing>& crossings, const std::vector<ClothGuard::Cloth>& cloths) {
  int count = 0;
  m_first.clear();
  for (const ClothGuard::Cloth& cloth : cloths) {
    m_first.push_back(count);
    count += cloth.nodeCount;
  }
  m_exemptions.set(crossings, toSize(count));
  m_aside.resize(crossings.empty() ? 0 : toSize(count));
  m_pairs.clear();
  m_contours.find(crossings);
  m_sums.assign(toSize(m_contours.count()), {btVector3(0, 0, 0), 0});
  for (const Crossing& crossing : crossings) m_pairs.push_back({crossing, {}, btVector3(0, 0, 0), true});
}

void Untangling::push(const std::vector<ClothGuard::Cloth>& cloths) {
  if (m_pairs.empty()) return;
  std::fill(m_aside.begin(), m_aside.end(), btVector3(0, 0, 0));
  for (Pair& pair : m_pairs) aim(pair, cloths);
  sumUp();
  for (std::size_t k = 0; k < m_pairs.size(); ++k) drawApart(m_pairs[k], ofContour(k), cloths);
}

// The gradient of the paper: the edge's end of the curve is moved along it, and the edge across the face that it goes
// through. None when the parts have come apart.
void Untangling::aim(Pair& pair, const std::vector<ClothGuard::Cloth>& cloths) const {
  const Crossing& crossing = pair.crossing;
  const ClothGuard::Cloth& cloth = cloths[toSize(crossing.cloth[0])];
  const ClothGuard::Cloth& other = cloths[toSize(crossing.cloth[1])];
  const auto placeOfEdge = [&](int node) {
    return crossingPlaceOf(cloth, node - m_first[toSize(crossing.cloth[0])], cloth.origin);
  };
  const auto placeOfFace = [&](int node) {
    return crossingPlaceOf(other, node - m_first[toSize(crossing.cloth[1])], cloth.origin);
  };
  const BodyPoint p = placeOfEdge(crossing.edge[0]);
  const BodyPoint q = placeOfEdge(crossing.edge[1]);
  const BodyPoint a = placeOfFace(crossing.face[0]);
  const BodyPoint b = placeOfFace(crossing.face[1]);
  const BodyPoint c = placeOfFace(crossing.face[2]);
  pair.gradient.setZero();
  const std::optional<CrossingPoint> point = crossingPoint(p, q, a, b, c);
  pair.isCrossing = point.has_value();
  if (!point) return;
  for (std::size_t k = 0; k < 3; ++k) pair.weight[2 + k] = -static_cast<btScalar>(point->weight[k]);
  pair.weight[1] = static_cast<btScalar>(point->along);
  pair.weight[0] = 1 - pair.weight[1];
  const btVector3 normal = unit(wayTo(a, b).cross(wayTo(a, c)));
  const btVector3 edge = unit(wayTo(p, q));
  btVector3 along(0, 0, 0);
  for (const int third : crossing.beside) {
    if (third >= 0) along += intoFace(edge, wayTo(p, placeOfEdge(third)), normal);
  }
  const btVector3 gradient = along - normal * (2 * edge.dot(along) / edge.dot(normal));
  const btScalar length = gradient.length();
  if (std::isfinite(length)) pair.gradient = length > kMostGradient ? gradient * (kMostGradient / length) : gradient;
}

// A contour that is gone keeps what it was last.
void Untangling::sumUp() {
  m_newSums.assign(m_sums.size(), {btVector3(0, 0, 0), 0});
  for (std::size_t k = 0; k < m_pairs.size(); ++k) {
    Sum& sum = m_newSums[toSize(m_contours.contour(k))];
    sum.gradient += m_contours.isOfOtherLayer(k) ? -m_pairs[k].gradient : m_pairs[k].gradient;
    sum.size += m_pairs[k].gradient.length();
  }
  for (std::size_t k = 0; k < m_sums.size(); ++k) {
    if (m_newSums[k].size > 0) m_sums[k] = m_newSums[k];
  }
}

// The sum of the gradients along a contour, less so where they do not agree.
btVector3 Untangling::ofContour(std::size_t pair) const {
  const Sum& sum = m_sums[toSize(m_contours.contour(pair))];
  if (!(sum.size > 0)) return btVector3(0, 0, 0);
  const btVector3 agreed = sum.gradient * (sum.gradient.length() / sum.size);
  return m_contours.isOfOtherLayer(pair) ? -agreed : agreed;
}

Untangling::Pull::Pull(const btVector3& gradient)
    : direction(unit(gradient)), size(gradient.length() / std::sqrt(1 + gradient.length2())) {}

// Velocities against the contour's direction are taken away until the step is over, of what has come apart, too: else
// it would cross again before the guard may look. At a contour's end, on a border, its own direction counts as well.
void Untangling::drawApart(const Pair& pair, const btVector3& ofContour, const std::vector<ClothGuard::Cloth>& cloths) {
  const bool isEnd = pair.crossing.beside[1] < 0;
  const Pull held(isEnd ? pair.gradient + ofContour : ofContour);
  const Pull drawn(pair.isCrossing ? pair.gradient + ofContour : btVector3(0, 0, 0));
  const Grip grip = gripOf(pair, cloths);
  if (!(grip.yield > 0)) return;
  const btVector3 stop = held.direction * (held.size * std::max(-grip.way.dot(held.direction), btScalar(0)));
  const btScalar known =
      std::max((grip.way + stop).dot(drawn.direction), btScalar(0)) + grip.aside.dot(drawn.direction);
  const btVector3 move = drawn.direction * std::max(grip.most * drawn.size - known, btScalar(0));
  for (std::size_t k = 0; k < 5; ++k) {
    const MovingNodes& nodes = cloths[toSize(pair.crossing.cloth[k < 2 ? 0 : 1])].nodes;
    for (int axis = 0; axis < 3; ++axis) {
      nodes.position[axis][grip.slots[k]] += (stop[axis] + move[axis]) * grip.shares[k];
      nodes.predicted[axis][grip.slots[k]] += move[axis] * grip.shares[k];
    }
    m_aside[toSize(grip.nodes[k])] += move * grip.shares[k];
  }
}

// No node goes further than the two points are to come apart, whatever their weights are.
Untangling::Grip Untangling::gripOf(const Pair& pair, const std::vector<ClothGuard::Cloth>& cloths) const {
  const Crossing& crossing = pair.crossing;
  Grip grip = {{crossing.edge[0], crossing.edge[1], crossing.face[0], crossing.face[1], crossing.face[2]},
               {},
               {},
               0,
               btVector3(0, 0, 0),
               btVector3(0, 0, 0),
               std::numeric_limits<btScalar>::max()};
  btScalar largest = 0;
  for (std::size_t k = 0; k < 5; ++k) {
    const std::size_t which = toSize(crossing.cloth[k < 2 ? 0 : 1]);
    const ClothGuard::Cloth& cloth = cloths[which];
    grip.slots[k] = toSize(cloth.slots[grip.nodes[k] - m_first[which]]);
    grip.shares[k] = cloth.isStill ? 0 : pair.weight[k] * cloth.nodes.inverseMass[grip.slots[k]];
    grip.yield += grip.shares[k] * pair.weight[k];
    largest = std::max(largest, std::fabs(grip.shares[k]));
    if (!cloth.isStill) grip.way += cloth.nodes.wayOf(grip.slots[k], cloth.h) * pair.weight[k];
    grip.aside += m_aside[toSize(grip.nodes[k])] * pair.weight[k];
    grip.most = std::min({grip.most, kSpeed * cloth.h, kMostOfEdge * static_cast<btScalar>(cloth.mesh->edgeLength)});
  }
  for (btScalar& share : grip.shares) share /= std::max({grip.yield, largest, std::numeric_limits<btScalar>::min()});
  return grip;
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
