// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/Separation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

using Point = double[3];

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
void subtract(const Point& a, const Point& b, Point& result) {
  for (int k = 0; k < 3; ++k) result[k] = a[k] - b[k];
}
void cross(const Point& a, const Point& b, Point& result) {
  result[0] = a[1] * b[2] - a[2] * b[1];
  result[1] = a[2] * b[0] - a[0] * b[2];
  result[2] = a[0] * b[1] - a[1] * b[0];
}

double inUnit(double x) { return std::min(std::max(x, 0.0), 1.0); }

// From the weights: normal and distance.
void finish(const double (&nodes)[4][3], Separation& result) {
  Point way = {0, 0, 0};
  // Differences from one node: a sum of places far from the origin would round more.
  for (int node = 1; node < 4; ++node) {
    for (int k = 0; k < 3; ++k) way[k] += result.weights[node] * (nodes[node][k] - nodes[0][k]);
  }
  result.distance = std::sqrt(dot(way, way));
  const double scale = result.distance > 0 ? 1 / result.distance : 0;
  for (int k = 0; k < 3; ++k) result.normal[k] = way[k] * scale;
}

// Where the nearest places are inside both parts, the way between them is across both: near each other, that is known
// to more digits than the way itself.
void turnAcross(const Point& u, const Point& v, Separation& result) {
  Point across;
  cross(u, v, across);
  const double length = std::sqrt(dot(across, across));
  constexpr double kAlong = 1e-3;  // sine of the angle between nearly parallel sides
  if (!(length > kAlong * std::sqrt(dot(u, u) * dot(v, v)))) return;
  const double scale = dot(across, result.normal) < 0 ? -1 / length : 1 / length;
  for (int k = 0; k < 3; ++k) result.normal[k] = across[k] * scale;
}

// Where on the segment from a to b the origin is nearest, as a share of it.
double nearestOnSegment(const Point& a, const Point& b) {
  Point along;
  subtract(b, a, along);
  const double length2 = dot(along, along);
  return length2 > 0 ? inUnit(-dot(a, along) / length2) : 0;
}

}  // namespace

Separation separationOfVertexAndFace(const double (&nodes)[4][3]) {
  Point corner[3];  // from the vertex
  for (int k = 0; k < 3; ++k) subtract(nodes[k + 1], nodes[0], corner[k]);
  Point u, v, normal;
  subtract(corner[1], corner[0], u);
  subtract(corner[2], corner[0], v);
  cross(u, v, normal);
  const double area2 = dot(normal, normal);
  Separation result = {{0, 0, 0}, {1, 0, 0, 0}, 0};
  if (area2 > 0) {
    double weight[3];
    double least = 1;
    for (int k = 0; k < 3; ++k) {
      Point across;
      cross(corner[(k + 1) % 3], corner[(k + 2) % 3], across);
      weight[k] = dot(across, normal) / area2;
      least = std::min(least, weight[k]);
    }
    if (least >= 0) {
      for (int k = 0; k < 3; ++k) result.weights[k + 1] = -weight[k];
      finish(nodes, result);
      turnAcross(u, v, result);
      return result;
    }
  }
  double nearest = -1;
  for (int k = 0; k < 3; ++k) {
    const Point& a = corner[k];
    const Point& b = corner[(k + 1) % 3];
    const double share = nearestOnSegment(a, b);
    Point place;
    for (int axis = 0; axis < 3; ++axis) place[axis] = a[axis] + share * (b[axis] - a[axis]);
    const double distance2 = dot(place, place);
    if (nearest >= 0 && distance2 >= nearest) continue;
    nearest = distance2;
    for (double& weight : result.weights) weight = 0;
    result.weights[0] = 1;
    result.weights[k + 1] = share - 1;
    result.weights[(k + 1) % 3 + 1] = -share;
  }
  finish(nodes, result);
  return result;
}

Separation separationOfEdges(const double (&nodes)[4][3]) {
  Point u, v, between;
  subtract(nodes[1], nodes[0], u);
  subtract(nodes[3], nodes[2], v);
  subtract(nodes[0], nodes[2], between);
  const double uu = dot(u, u);
  const double vv = dot(v, v);
  const double uv = dot(u, v);
  const double ub = dot(u, between);
  const double vb = dot(v, between);
  const double determinant = uu * vv - uv * uv;
  double s = determinant > 1e-12 * uu * vv ? inUnit((uv * vb - vv * ub) / determinant) : 0.5;
  double t = vv > 0 ? inUnit((uv * s + vb) / vv) : 0;
  s = uu > 0 ? inUnit((uv * t - ub) / uu) : 0;
  t = vv > 0 ? inUnit((uv * s + vb) / vv) : 0;
  Separation result = {{0, 0, 0}, {1 - s, s, t - 1, -t}, 0};
  finish(nodes, result);
  if (s > 0 && s < 1 && t > 0 && t < 1) turnAcross(u, v, result);
  return result;
}

Separation separationOfEdgesAtAnEnd(const double (&nodes)[4][3]) {
  Separation nearest = {{0, 0, 0}, {0, 0, 0, 0}, std::numeric_limits<double>::infinity()};
  for (int end = 0; end < 4; ++end) {
    const int first = end < 2 ? 2 : 0;  // of the other edge
    Point a, b;
    subtract(nodes[first], nodes[end], a);
    subtract(nodes[first + 1], nodes[end], b);
    const double share = nearestOnSegment(a, b);
    const double sign = end < 2 ? 1 : -1;
    Separation candidate = {{0, 0, 0}, {0, 0, 0, 0}, 0};
    candidate.weights[end] = sign;
    candidate.weights[first] = -sign * (1 - share);
    candidate.weights[first + 1] = -sign * share;
    finish(nodes, candidate);
    if (candidate.distance < nearest.distance) nearest = candidate;
  }
  return nearest;
}

// The gap between the two nodes that are nearest along the normal becomes what it may be at most, in turns: each turn
// is by as little as that takes.
void turnApart(const double (&nodes)[4][3], int first, Separation& separation) {
  constexpr int kTurns = 8;
  constexpr double kNear = 0.99;  // of the distance
  for (int turn = 0; turn < kTurns; ++turn) {
    int low = 0, high = 0;
    const double gap = gapAlong(separation.normal, nodes, first, low, high);
    if (!(gap < kNear * separation.distance)) return;
    Point way;
    subtract(nodes[low], nodes[high], way);
    const double length2 = dot(way, way);
    if (!(length2 > 0)) return;
    const double share = (separation.distance - gap) / length2;
    for (int k = 0; k < 3; ++k) separation.normal[k] += share * way[k];
    const double length = std::sqrt(dot(separation.normal, separation.normal));
    for (double& x : separation.normal) x /= length;
  }
}

double gapAlong(const double (&normal)[3], const double (&nodes)[4][3], int first, int& low, int& high) {
  double along[4];
  for (int node = 0; node < 4; ++node) {
    Point way;
    subtract(nodes[node], nodes[0], way);
    along[node] = dot(way, normal);
  }
  low = static_cast<int>(std::min_element(along, along + first) - along);
  high = static_cast<int>(std::max_element(along + first, along + 4) - along);
  return along[low] - along[high];
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
