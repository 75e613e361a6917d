// SPDX-License-Identifier: Zlib
#pragma once

// What the tests of the collision checks know of a query by themselves: where its points are, how fast and how near.
// All of it in long double, so that its own rounding is small beside what is tested.

#include <bullet_wetcloth/collision/ContinuousCheck.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <type_traits>
#include <vector>

namespace wetcloth_test {

using wetcloth::collision::CheckSettings;
using wetcloth::collision::Contact;
using wetcloth::collision::ContinuousCheck;
using wetcloth::collision::Pair;
using wetcloth::collision::Query;
using wetcloth::collision::Tier;

using Point = std::array<long double, 3>;

inline Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Point operator+(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Point operator*(long double f, const Point& a) { return {f * a[0], f * a[1], f * a[2]}; }
inline long double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline long double length(const Point& a) { return std::sqrt(dot(a, a)); }

/// For INSTANTIATE_TEST_SUITE_P.
struct NameOfPair {
  template <class Info>
  std::string operator()(const Info& test) const {
    return test.param == Pair::vertexFace ? "vertexFace" : "edgeEdge";
  }
};

template <class To, class From>
Query<To> converted(const Query<From>& query) {
  Query<To> result;
  for (int i = 0; i < 4; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      result.start[i][axis] = static_cast<To>(query.start[i][axis]);
      result.end[i][axis] = static_cast<To>(query.end[i][axis]);
    }
  }
  return result;
}

/// A literal to paste into a test: hex floats, so that not a bit is lost.
template <class Scalar>
std::string literal(Pair pair, const Query<Scalar>& query) {
  std::string text = pair == Pair::vertexFace ? "vertexFace {" : "edgeEdge {";
  for (const auto* points : {&query.start, &query.end}) {
    text += points == &query.start ? "{" : ", {";
    for (int i = 0; i < 4; ++i) {
      char point[128];
      std::snprintf(point, sizeof point, "%s{%a, %a, %a}", i > 0 ? ", " : "", static_cast<double>((*points)[i][0]),
                    static_cast<double>((*points)[i][1]), static_cast<double>((*points)[i][2]));
      text += point;
    }
    text += "}";
  }
  return text + (std::is_same<Scalar, float>::value ? "} (float)" : "} (double)");
}

template <class Scalar>
Point pointAt(const Query<Scalar>& query, int i, long double time) {
  Point point;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const long double from = query.start[i][axis];
    const long double to = query.end[i][axis];
    point[axis] = (1 - time) * from + time * to;
  }
  return point;
}

/// No two material points of the pair move faster relative to each other: speeds are convex combinations.
template <class Scalar>
long double relativeSpeed(Pair pair, const Query<Scalar>& query) {
  const int split = pair == Pair::vertexFace ? 1 : 2;
  long double speed = 0;
  for (int i = 0; i < split; ++i) {
    for (int j = split; j < 4; ++j) {
      speed = std::max(
          speed, length((pointAt(query, i, 1) - pointAt(query, i, 0)) - (pointAt(query, j, 1) - pointAt(query, j, 0))));
    }
  }
  return speed;
}

/// The largest coordinate.
template <class Scalar>
long double magnitude(const Query<Scalar>& query) {
  long double largest = 0;
  for (int i = 0; i < 4; ++i) {
    for (const long double time : {0.0L, 1.0L})
      for (const long double coordinate : pointAt(query, i, time)) largest = std::max(largest, std::abs(coordinate));
  }
  return largest;
}

/// How far the four points are from one another, at most, at the start or at the end.
template <class Scalar>
long double extent(const Query<Scalar>& query) {
  long double largest = 0;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < i; ++j) {
      for (const long double time : {0.0L, 1.0L})
        largest = std::max(largest, length(pointAt(query, i, time) - pointAt(query, j, time)));
    }
  }
  return largest;
}

/// Between the two points that `where` names.
template <class Scalar>
long double distanceOf(Pair pair, const Query<Scalar>& query, long double time, const double (&where)[2]) {
  const Point p0 = pointAt(query, 0, time), p1 = pointAt(query, 1, time);
  const Point p2 = pointAt(query, 2, time), p3 = pointAt(query, 3, time);
  const long double a = where[0], b = where[1];
  if (pair == Pair::vertexFace) return length(p1 + a * (p2 - p1) + b * (p3 - p1) - p0);
  return length(p0 + a * (p1 - p0) - (p2 + b * (p3 - p2)));
}

inline long double pointToSegment(const Point& point, const Point& from, const Point& to) {
  const Point along = to - from;
  const long double square = dot(along, along);
  const long double t = square > 0 ? std::clamp(dot(point - from, along) / square, 0.0L, 1.0L) : 0;
  return length(from + t * along - point);
}

/// Sines below 1e-9, squared: the direction of a cross product this short has less than ten digits of long double left.
constexpr long double kFlat = 1e-18L;

/// Between the nearest points of the two; more where the face or the edges are too flat to have a normal.
template <class Scalar>
long double distanceAt(Pair pair, const Query<Scalar>& query, long double time) {
  const Point p0 = pointAt(query, 0, time), p1 = pointAt(query, 1, time);
  const Point p2 = pointAt(query, 2, time), p3 = pointAt(query, 3, time);
  if (pair == Pair::vertexFace) {
    long double nearest =
        std::min({pointToSegment(p0, p1, p2), pointToSegment(p0, p2, p3), pointToSegment(p0, p3, p1)});
    const Point normal = cross(p2 - p1, p3 - p1);
    const long double square = dot(normal, normal);
    const Point u = p2 - p1, v = p3 - p1;
    const bool inside = square > kFlat * dot(u, u) * dot(v, v) && dot(cross(p2 - p1, p0 - p1), normal) >= 0 &&
                        dot(cross(p3 - p2, p0 - p2), normal) >= 0 && dot(cross(p1 - p3, p0 - p3), normal) >= 0;
    if (inside) nearest = std::min(nearest, std::abs(dot(normal, p0 - p1)) / std::sqrt(square));
    return nearest;
  }
  long double nearest = std::min(
      {pointToSegment(p0, p2, p3), pointToSegment(p1, p2, p3), pointToSegment(p2, p0, p1), pointToSegment(p3, p0, p1)});
  const Point u = p1 - p0, v = p3 - p2, w = p2 - p0;
  const Point normal = cross(u, v);
  const long double square = dot(normal, normal);
  if (square > kFlat * dot(u, u) * dot(v, v)) {
    const long double s = dot(cross(w, v), normal) / square;
    const long double t = dot(cross(w, u), normal) / square;
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1) nearest = std::min(nearest, std::abs(dot(w, normal)) / std::sqrt(square));
  }
  return nearest;
}

/// What rounding may add to the distance of the points that `where` names. A nearest point from normal equations in
/// double has lost half of the 52 bits, and 2 more to the steps; the points themselves are off by roundings of their
/// coordinates.
template <class Scalar>
long double whereRounding(const Query<Scalar>& query) {
  return std::ldexp(extent(query), -24) + std::ldexp(magnitude(query), -48);
}

inline bool whereInRange(Pair pair, const Contact& contact) {
  const double a = contact.where[0], b = contact.where[1];
  const bool each = a >= 0 && a <= 1 && b >= 0 && b <= 1;
  return each && (pair == Pair::edgeEdge || a + b <= 1);
}

/// One of the ways to ask: a tier, one query at a time or a batch.
struct Way {
  const char* name;
  Tier tier;
  bool batch;
};

inline std::vector<Way> everyWay() {
  std::vector<Way> ways = {{"fast", Tier::fast, false},
                           {"fast batch", Tier::fast, true},
                           {"conservative", Tier::conservative, false},
                           {"conservative batch", Tier::conservative, true}};
  if (ContinuousCheck::hasExact()) {
    ways.push_back({"exact", Tier::exact, false});
    ways.push_back({"exact batch", Tier::exact, true});
  }
  return ways;
}

/// The answer to one query. A batch is nine copies of it, which fills vector registers and leaves a rest; of its
/// answers the worst one is returned: one that found nothing, otherwise the latest.
template <class Scalar>
Contact ask(const Way& way, Pair pair, const Query<Scalar>& query, const CheckSettings& settings = {}) {
  const ContinuousCheck check(way.tier, settings);
  if (!way.batch) return check(pair, query);
  const std::vector<Query<Scalar>> queries(9, query);
  Contact contacts[9];
  check(pair, queries.data(), queries.size(), contacts);
  return *std::max_element(contacts, contacts + 9, [](const Contact& a, const Contact& b) {
    if (a.found != b.found) return a.found;
    return a.time < b.time;
  });
}

}  // namespace wetcloth_test
