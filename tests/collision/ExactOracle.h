// SPDX-License-Identifier: Zlib
#pragma once

// Whether and when two primitives meet, by means that have nothing in common with the library's: Sturm-Tarski
// sequences, scalar products in space instead of areas seen along the axes. Slow.

#include <bullet_wetcloth/collision/Query.h>

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace wetcloth_test::oracle {

using Integer = boost::multiprecision::cpp_int;
using Rational = boost::multiprecision::cpp_rational;
using Polynomial = std::vector<Integer>;   // lowest degree first, no zeros at the end
using Vector = std::array<Polynomial, 3>;  // of time

inline Polynomial trimmed(Polynomial p) {
  while (!p.empty() && p.back() == 0) p.pop_back();
  return p;
}

inline Polynomial operator+(Polynomial a, const Polynomial& b) {
  a.resize(std::max(a.size(), b.size()));
  for (std::size_t i = 0; i < b.size(); ++i) a[i] += b[i];
  return trimmed(a);
}

inline Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  Polynomial product(a.size() + b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) product[i + j] += a[i] * b[j];
  return trimmed(product);
}

inline Polynomial operator-(const Polynomial& a, const Polynomial& b) { return a + Polynomial{-1} * b; }

inline Polynomial primitive(Polynomial p) {
  Integer content = 0;
  for (const Integer& coefficient : p) content = gcd(content, coefficient);
  for (Integer& coefficient : p) coefficient /= content;
  return p;
}

/// Of the division of a by b, times a positive number.
inline Polynomial remainder(Polynomial a, const Polynomial& b) {
  const Polynomial scale = {b.back() * b.back()};
  while (a.size() >= b.size()) {
    Polynomial factor(a.size() - b.size() + 1);
    factor.back() = a.back() * b.back();
    a = scale * a - factor * b;
  }
  return primitive(a);
}

inline int signOfValue(const Polynomial& p, const Rational& t) {
  const Integer top = numerator(t);
  const Integer bottom = denominator(t);
  Integer value = 0;
  Integer scale = 1;
  for (std::size_t i = p.size(); i-- > 0; scale *= bottom) value = value * top + p[i] * scale;
  return value.sign();
}

inline int signChanges(const std::vector<Polynomial>& sequence, const Rational& t) {
  int changes = 0;
  int last = 0;
  for (const Polynomial& p : sequence) {
    const int sign = signOfValue(p, t);
    if (sign != 0 && sign == -last) ++changes;
    if (sign != 0) last = sign;
  }
  return changes;
}

/// Sturm and Tarski: of the roots of p in (low, high), those with g > 0 less those with g < 0.
inline int tarskiQuery(const Polynomial& p, const Polynomial& g, const Rational& low, const Rational& high) {
  Polynomial derivative;
  for (std::size_t i = 1; i < p.size(); ++i) derivative.push_back(p[i] * i);
  std::vector<Polynomial> sequence = {primitive(p), primitive(derivative * g)};
  while (!sequence.back().empty())
    sequence.push_back(Polynomial{-1} * remainder(sequence[sequence.size() - 2], sequence.back()));
  return signChanges(sequence, low) - signChanges(sequence, high);
}

/// The only root of p between low and high, neither of which is one.
struct Root {
  Polynomial p;
  Rational low;
  Rational high;
  int sign(const Polynomial& g) const { return g.empty() ? 0 : tarskiQuery(p, g, low, high); }
};

/// A number a little above that is no root.
inline Rational besides(const Polynomial& p, Rational t, Rational step) {
  while (signOfValue(p, t) == 0) t += step /= 3;
  return t;
}

inline void isolate(const Polynomial& p, const Rational& low, const Rational& high, std::vector<Root>& roots) {
  const int count = tarskiQuery(p, {1}, low, high);
  if (count == 1) roots.push_back({p, low, high});
  if (count < 2) return;
  const Rational middle = besides(p, (low + high) / 2, (high - low) / 2);
  isolate(p, low, middle, roots);
  isolate(p, middle, high, roots);
}

inline std::vector<Root> rootsInUnitInterval(const Polynomial& p) {
  std::vector<Root> roots;
  if (p.empty()) return roots;
  isolate(p, besides(p, Rational(-1, 2), Rational(1, 2)), besides(p, Rational(3, 2), Rational(1, 2)), roots);
  const auto isOutside = [](const Root& root) { return root.sign({0, 1}) < 0 || root.sign({1, -1}) < 0; };
  roots.erase(std::remove_if(roots.begin(), roots.end(), isOutside), roots.end());
  return roots;
}

inline Vector operator-(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Polynomial dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Looks at the two of a query in space: whether they meet at a root, and every polynomial that has a say in that.
class Oracle {
 public:
  Oracle(wetcloth::collision::Pair pair, const wetcloth::collision::Query<double>& query) {
    int unit = 0;
    for (const auto* points : {&query.start, &query.end}) {
      for (const auto& point : *points) {
        for (const double coordinate : point)
          if (coordinate != 0) unit = std::min(unit, std::ilogb(coordinate) - 52);
      }
    }
    for (int i = 0; i < 4; ++i) {
      for (int k = 0; k < 3; ++k) {
        const Integer start = integer(query.start[i][k], unit);
        m_point[i][k] = trimmed({start, integer(query.end[i][k], unit) - start});
      }
    }
    const Vector& p0 = m_point[0];
    const Vector u = m_point[1] - p0;
    const Vector w = m_point[2] - p0;
    m_volume = dot(cross(u, w), m_point[3] - p0);
    if (pair == wetcloth::collision::Pair::vertexFace) {
      m_normal = cross(m_point[2] - m_point[1], m_point[3] - m_point[1]);
      for (int i = 1; i <= 3; ++i) {
        const Vector& from = m_point[i];
        const Vector& to = m_point[i % 3 + 1];
        m_conditions.push_back(dot(cross(to - from, p0 - from), m_normal));
        addSegment(p0, from, to);
      }
    } else {
      const Vector v = m_point[3] - m_point[2];
      m_normal = cross(u, v);
      for (const Polynomial& parameter : {dot(cross(w, v), m_normal), dot(cross(w, u), m_normal)}) {
        m_conditions.push_back(parameter);
        m_conditions.push_back(dot(m_normal, m_normal) - parameter);
      }
      for (int i = 0; i < 2; ++i) {
        addSegment(m_point[i], m_point[2], m_point[3]);
        addSegment(m_point[2 + i], m_point[0], m_point[1]);
      }
    }
  }

  bool isInOnePlane() const { return m_volume.empty(); }

  /// Times of contact, the first among them.
  std::vector<Root> contacts() const {
    std::vector<Polynomial> candidates = {m_volume};
    if (isInOnePlane()) {
      candidates = m_conditions;
      candidates.push_back({0, 1});
      candidates.push_back(dot(m_normal, m_normal));
      for (const Segment& segment : m_segments) {
        candidates.push_back(segment.offLine);
        candidates.push_back(segment.between);
      }
    }
    std::vector<Root> contacts;
    for (const Polynomial& candidate : candidates) {
      for (const Root& root : rootsInUnitInterval(candidate))
        if (meetAt(root)) contacts.push_back(root);
    }
    return contacts;
  }

 private:
  /// In units of 2^unit.
  static Integer integer(double coordinate, int unit) {
    int exponent = 0;
    const double fraction = std::frexp(coordinate, &exponent);
    return coordinate == 0 ? Integer(0) : Integer(std::ldexp(fraction, 53)) << (exponent - 53 - unit);
  }

  struct Segment {
    Polynomial offLine;
    Polynomial between;
  };

  void addSegment(const Vector& point, const Vector& from, const Vector& to) {
    const Vector area = cross(point - from, to - from);
    m_segments.push_back({dot(area, area), dot(point - from, point - to)});
  }

  bool meetAt(const Root& root) const {
    if (root.sign(m_volume) != 0) return false;
    if (root.sign(dot(m_normal, m_normal)) != 0)
      return std::all_of(m_conditions.begin(), m_conditions.end(), [&](const auto& p) { return root.sign(p) >= 0; });
    // The face is no more than its edges; the edges are parallel or points: an end of one is on the other.
    return std::any_of(m_segments.begin(), m_segments.end(), [&](const Segment& segment) {
      return root.sign(segment.offLine) == 0 && root.sign(segment.between) <= 0;
    });
  }

  std::array<Vector, 4> m_point;
  Polynomial m_volume;
  Vector m_normal;
  std::vector<Polynomial> m_conditions;
  std::vector<Segment> m_segments;
};

}  // namespace wetcloth_test::oracle
