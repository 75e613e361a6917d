// SPDX-License-Identifier: Zlib
#pragma once

// What the methods for comparison share: plain floating point without error bounds. Nothing here is fit for a check
// that must not miss.

#include "bullet_wetcloth/collision/Query.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace command::comparison {

using wetcloth::collision::Contact;
using wetcloth::collision::Pair;
using wetcloth::collision::Query;

template <class Scalar>
struct Vector {
  Scalar x, y, z;

  Vector operator+(const Vector& other) const { return {x + other.x, y + other.y, z + other.z}; }
  Vector operator-(const Vector& other) const { return {x - other.x, y - other.y, z - other.z}; }
  Vector operator*(Scalar factor) const { return {x * factor, y * factor, z * factor}; }
  Scalar dot(const Vector& other) const { return x * other.x + y * other.y + z * other.z; }
  Vector cross(const Vector& other) const {
    return {y * other.z - z * other.y, z * other.x - x * other.z, x * other.y - y * other.x};
  }
};

template <class Scalar>
Vector<Scalar> vectorOf(const Scalar (&point)[3]) {
  return {point[0], point[1], point[2]};
}

/// The points of a query relative to point 0, and how they move.
template <class Scalar>
struct Motion {
  Vector<Scalar> start[3];
  Vector<Scalar> velocity[3];

  explicit Motion(const Query<Scalar>& query) {
    for (int i = 0; i < 3; ++i) {
      start[i] = vectorOf(query.start[i + 1]) - vectorOf(query.start[0]);
      velocity[i] = vectorOf(query.end[i + 1]) - vectorOf(query.end[0]) - start[i];
    }
  }
  Vector<Scalar> at(int i, Scalar time) const { return start[i] + velocity[i] * time; }
};

/// f(t) = a[0] + a[1] t + a[2] t^2 + a[3] t^3, six times the signed volume of the four points.
template <class Scalar>
struct PowerCubic {
  Scalar a[4];

  explicit PowerCubic(const Motion<Scalar>& motion) {
    const auto& [p, q, r] = motion.start;
    const auto& [u, v, w] = motion.velocity;
    const Vector<Scalar> area = p.cross(q);
    const Vector<Scalar> areaChange = p.cross(v) + u.cross(q);
    const Vector<Scalar> areaCurve = u.cross(v);
    a[0] = area.dot(r);
    a[1] = areaChange.dot(r) + area.dot(w);
    a[2] = areaCurve.dot(r) + areaChange.dot(w);
    a[3] = areaCurve.dot(w);
  }
  Scalar value(Scalar t) const { return a[0] + t * (a[1] + t * (a[2] + t * a[3])); }
  Scalar slope(Scalar t) const { return a[1] + t * (2 * a[2] + t * 3 * a[3]); }
};

/// Real roots of c + b x + a x^2 in ascending order, without cancellation; none when all three are 0.
template <class Scalar>
int quadraticRoots(Scalar a, Scalar b, Scalar c, Scalar* roots) {
  if (a == 0) {
    if (b == 0) return 0;
    roots[0] = -c / b;
    return 1;
  }
  const Scalar discriminant = b * b - 4 * a * c;
  if (!(discriminant >= 0)) return 0;
  const Scalar q = Scalar(-0.5) * (b + std::copysign(std::sqrt(discriminant), b));
  roots[0] = q / a;
  roots[1] = q == 0 ? 0 : c / q;
  if (roots[0] > roots[1]) std::swap(roots[0], roots[1]);
  return 2;
}

/// Whether the two of a query meet at a time when their four points lie in one plane: barycentric weights, not farther
/// than `tolerance` outside. A face without area or parallel edges never do.
template <class Scalar>
bool meetInPlane(Pair pair, const Motion<Scalar>& motion, Scalar time, Scalar tolerance, Contact& contact) {
  const Vector<Scalar> p1 = motion.at(0, time);
  const Vector<Scalar> p2 = motion.at(1, time);
  const Vector<Scalar> p3 = motion.at(2, time);
  const bool isFace = pair == Pair::vertexFace;
  // Of the face: from point 1 to the vertex, which is the origin. Of the edges: from point 0 to point 2.
  const Vector<Scalar> gap = isFace ? p1 * Scalar(-1) : p2;
  const Vector<Scalar> first = isFace ? p2 - p1 : p1;
  const Vector<Scalar> second = p3 - (isFace ? p1 : p2);
  const Vector<Scalar> normal = first.cross(second);
  const Scalar area = normal.dot(normal);
  if (!(area > 0)) return false;
  const Scalar s = gap.cross(second).dot(normal) / area;
  const Scalar t = (isFace ? first.cross(gap) : gap.cross(first)).dot(normal) / area;
  const Scalar low = -tolerance;
  const Scalar high = 1 + tolerance;
  const bool inside = s >= low && t >= low && (isFace ? s + t <= high : s <= high && t <= high);
  if (!inside) return false;
  contact.found = true;
  contact.time = static_cast<double>(time);
  contact.where[0] = std::clamp(static_cast<double>(s), 0., 1.);
  contact.where[1] = std::clamp(static_cast<double>(t), 0., isFace ? 1 - contact.where[0] : 1.);
  return true;
}

}  // namespace command::comparison
