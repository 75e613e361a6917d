// SPDX-License-Identifier: Zlib
#include "command/scene/EarClipping.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace command {
namespace {

using Flat = std::array<double, 2>;

/// The polygon's points in the plane across its normal, counter-clockwise.
std::vector<Flat> flattened(const std::vector<Point>& corners) {
  Point normal{0, 0, 0};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point& a = corners[i];
    const Point& b = corners[(i + 1) % corners.size()];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
      normal[axis] += (a[u] - b[u]) * (a[v] - corners[0][v] + b[v] - corners[0][v]);
    }
  }
  const auto steeper = [](double a, double b) { return std::abs(a) < std::abs(b); };
  const auto axis = static_cast<std::size_t>(std::max_element(normal.begin(), normal.end(), steeper) - normal.begin());
  const double turn = normal[axis] < 0 ? -1 : 1;
  std::vector<Flat> flat;
  for (const Point& corner : corners) flat.push_back({corner[(axis + 1) % 3] * turn, corner[(axis + 2) % 3]});
  return flat;
}

/// Twice the area of a triangle, > 0 counter-clockwise.
double turn(const Flat& a, const Flat& b, const Flat& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

class Clipper {
 public:
  explicit Clipper(const std::vector<Point>& corners) : m_points(flattened(corners)), m_left(corners.size()) {
    std::iota(m_left.begin(), m_left.end(), 0);
    double area = 0;
    for (std::size_t i = 1; i + 1 < m_points.size(); ++i) area += turn(m_points[0], m_points[i], m_points[i + 1]);
    m_flat = 1e-12 * std::abs(area);
  }

  std::vector<std::array<int, 3>> clip() {
    std::vector<std::array<int, 3>> triangles;
    while (m_left.size() > 3) {
      const std::size_t ear = findEar();
      triangles.push_back(triangleAt(ear));
      m_left.erase(m_left.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    triangles.push_back({m_left[0], m_left[1], m_left[2]});
    return triangles;
  }

 private:
  std::array<int, 3> triangleAt(std::size_t i) const {
    const std::size_t count = m_left.size();
    return {m_left[(i + count - 1) % count], m_left[i], m_left[(i + 1) % count]};
  }
  const Flat& point(int corner) const { return m_points[static_cast<std::size_t>(corner)]; }
  double turnAt(std::size_t i) const {
    const auto [a, b, c] = triangleAt(i);
    return turn(point(a), point(b), point(c));
  }

  /// From the second corner on, so that the ears of a convex polygon make a fan. Where none is an ear, as in a polygon
  /// that crosses itself, the corner that sticks out most.
  std::size_t findEar() const {
    const std::size_t count = m_left.size();
    std::vector<int> reflex;
    for (std::size_t i = 0; i < count; ++i) {
      if (!(turnAt(i) > m_flat)) reflex.push_back(m_left[i]);
    }
    std::size_t sharpest = 1;
    for (std::size_t k = 1; k <= count; ++k) {
      const std::size_t i = k % count;
      if (turnAt(i) > turnAt(sharpest)) sharpest = i;
      if (turnAt(i) > m_flat && holdsNone(triangleAt(i), reflex)) return i;
    }
    return sharpest;
  }

  bool holdsNone(const std::array<int, 3>& ear, const std::vector<int>& reflex) const {
    return std::none_of(reflex.begin(), reflex.end(), [&, a = ear[0], b = ear[1], c = ear[2]](int corner) {
      if (corner == a || corner == b || corner == c) return false;
      const Flat& place = point(corner);
      if (place == point(a) || place == point(c)) return false;  // a seam touches itself
      return turn(point(a), point(b), place) >= -m_flat && turn(point(b), point(c), place) >= -m_flat &&
             turn(point(c), point(a), place) >= -m_flat;
    });
  }

  std::vector<Flat> m_points;
  std::vector<int> m_left;  // corners, in their order
  double m_flat;            // a corner that turns less is straight
};

}  // namespace

std::vector<std::array<int, 3>> clipEars(const std::vector<Point>& corners) { return Clipper(corners).clip(); }

}  // namespace command
