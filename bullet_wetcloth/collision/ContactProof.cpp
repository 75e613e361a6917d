// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/collision/ContactProof.h"

namespace wetcloth::collision {
namespace {

/// Sign of a determinant at one time, or 0. 6 products, each rounded 5 times, their three factors wrong by 3.01 u of
/// the magnitude each: 6 (5 + 3 * 3.01) = 84.2.
template <Pair pair>
int signOfVolume(const PointDifferences<pair>& at, const Vector& magnitude) {
  const double volume = at.vectors[0].dot(at.vectors[1].cross(at.vectors[2]));
  const double error = 85 * kRoundoff * magnitude[0] * magnitude[1] * magnitude[2] + kUnderflow;
  return (volume > error) - (volume < -error);
}

/// Signs of one component of a(t) x b(t), a quadratic, in its Bernstein coefficients on an interval.
class AreaSign {
 public:
  AreaSign(int axis, const Vector& magnitude) : m_y((axis + 1) % 3), m_z((axis + 2) % 3) {
    // Four products (the inner coefficient, times two), each rounded 3 times, two factors wrong by 3.01 u each:
    // 4 (3 + 2 * 3.01) = 36.1.
    m_error = 37 * kRoundoff * magnitude[m_y] * magnitude[m_z] + kUnderflow;
  }

  /// The one sign that it has all the time, or 0.
  int operator()(const Vector& a0, const Vector& a1, const Vector& b0, const Vector& b1) const {
    const double start = component(a0, b0);
    const double middle = component(a0, b1) + component(a1, b0);
    const double end = component(a1, b1);
    if (start > m_error && middle > m_error && end > m_error) return 1;
    if (start < -m_error && middle < -m_error && end < -m_error) return -1;
    return 0;
  }

 private:
  double component(const Vector& a, const Vector& b) const { return a[m_y] * b[m_z] - a[m_z] * b[m_y]; }

  int m_y;
  int m_z;
  double m_error;
};

/// Along an axis, the coplanar point is inside the face when it sees the three edges turning one way.
bool insideAllTheTime(const PointDifferences<Pair::vertexFace>& first, const PointDifferences<Pair::vertexFace>& last,
                      const AreaSign& sign) {
  const auto& a = first.vectors;
  const auto& b = last.vectors;
  const int turn = sign(a[0], b[0], a[1], b[1]);
  return turn != 0 && sign(a[1], b[1], a[2], b[2]) == turn && sign(a[2], b[2], a[0], b[0]) == turn;
}

/// Along an axis, two coplanar edges cross when each one's ends are on different sides of the other.
bool insideAllTheTime(const PointDifferences<Pair::edgeEdge>& first, const PointDifferences<Pair::edgeEdge>& last,
                      const AreaSign& sign) {
  const auto& a = first.vectors;
  const auto& b = last.vectors;
  const int p2 = sign(a[0], b[0], a[1], b[1]);
  if (p2 == 0 || sign(a[0], b[0], a[2], b[2]) != -p2) return false;
  const int p0 = sign(a[1], b[1], a[2], b[2]);
  return p0 != 0 && sign(a[3], b[3], a[4], b[4]) == -p0;
}

}  // namespace

template <Pair pair>
bool provedContact(const PointDifferences<pair>& start, const PointDifferences<pair>& end, double t0, double t1) {
  const Vector size = magnitude<pair>(start.vectors, end.vectors) * (1 + 0x1p-40);
  const PointDifferences<pair> first = blend(start, end, t0);
  const PointDifferences<pair> last = blend(start, end, t1);
  if (signOfVolume(first, size) * signOfVolume(last, size) != -1) return false;
  // The axis along which the figure is seen largest.
  const auto& v = first.vectors;
  const Vector normal =
      pair == Pair::vertexFace ? Vector((v[1] - v[0]).cross(v[2] - v[0])) : Vector(v[0].cross(v[2] - v[1]));
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  return insideAllTheTime(first, last, AreaSign(axis, size));
}

template bool provedContact(const PointDifferences<Pair::vertexFace>&, const PointDifferences<Pair::vertexFace>&,
                            double, double);
template bool provedContact(const PointDifferences<Pair::edgeEdge>&, const PointDifferences<Pair::edgeEdge>&, double,
                            double);

}  // namespace wetcloth::collision
