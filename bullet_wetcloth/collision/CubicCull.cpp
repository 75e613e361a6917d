// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/collision/CubicCull.h"

#include <Eigen/Core>

#include <algorithm>
#include <limits>

namespace wetcloth::collision {
namespace {

static_assert(std::numeric_limits<float>::is_iec559, "a double out of float's range must become infinite");

constexpr int kLanes = 8;
/// The same number of several queries.
using Lanes = Eigen::Array<float, kLanes, 1>;
using Flags = Eigen::Array<bool, kLanes, 1>;

struct LaneVector {
  Lanes x;
  Lanes y;
  Lanes z;
};

LaneVector cross(const LaneVector& a, const LaneVector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Lanes dot(const LaneVector& a, const LaneVector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

LaneVector operator+(const LaneVector& a, const LaneVector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }

// As in IntervalTest on the whole of [0, 1], with the roundoff of float: the vectors are differences in double (of
// floats, exact or nearly so), rounded once more to float, so they are wrong by 1.01 u at most.
constexpr float kFloatRoundoff = 0x1p-24F;
constexpr float kOuter = 6 * (5 + 3 * 1.01F) + 1;   ///< one determinant: 6 (5 + 3 * 1.01) u |x||y||z|
constexpr float kInner = 18 * (7 + 3 * 1.01F) + 1;  ///< three of them: 18 (7 + 3 * 1.01) u |x||y||z|
/// Larger motions are left to double precision: with this bound nothing overflows, and underflow, 60 operations wrong
/// by 2^-126 at most (a flushed denormal) times two further factors, stays below kFloatUnderflow.
constexpr float kLargest = 0x1p17F;
constexpr float kFloatUnderflow = 0x1p-85F;

/// p1 - p0, p2 - p0 and p3 - p0 of some queries.
struct Vectors {
  LaneVector v[3];

  template <class Scalar>
  void fill(int lane, const Scalar (&p)[4][3]) {
    for (int i = 0; i < 3; ++i) {
      v[i].x[lane] = float(double(p[i + 1][0]) - double(p[0][0]));
      v[i].y[lane] = float(double(p[i + 1][1]) - double(p[0][1]));
      v[i].z[lane] = float(double(p[i + 1][2]) - double(p[0][2]));
    }
  }
};

template <class Component>
Lanes largest(const Vectors& start, const Vectors& end, const Component& component) {
  Lanes result = component(start.v[0]).abs().max(component(end.v[0]).abs());
  for (int i = 1; i < 3; ++i) result = result.max(component(start.v[i]).abs()).max(component(end.v[i]).abs());
  return result;
}

/// IntervalTest::neverCoplanar on [0, 1]. A coordinate that is not finite makes a magnitude infinite or both inner
/// coefficients not numbers, and then nothing is proved.
Flags neverCoplanar(const Vectors& start, const Vectors& end) {
  const auto& a = start.v;
  const auto& b = end.v;
  const LaneVector startNormal = cross(a[1], a[2]);
  const LaneVector mixedNormal = cross(a[1], b[2]) + cross(b[1], a[2]);
  const LaneVector endNormal = cross(b[1], b[2]);
  const Lanes c0 = dot(a[0], startNormal);
  const Lanes c1 = dot(b[0], startNormal) + dot(a[0], mixedNormal);
  const Lanes c2 = dot(b[0], mixedNormal) + dot(a[0], endNormal);
  const Lanes c3 = dot(b[0], endNormal);

  const Lanes x = largest(start, end, [](const LaneVector& v) { return v.x; });
  const Lanes y = largest(start, end, [](const LaneVector& v) { return v.y; });
  const Lanes z = largest(start, end, [](const LaneVector& v) { return v.z; });
  const Lanes volume = x * y * z * kFloatRoundoff;
  const Lanes outer = volume * kOuter + kFloatUnderflow;
  const Lanes inner = volume * kInner + kFloatUnderflow;
  const Flags positive = c0.min(c3) > outer && c1.min(c2) > inner;
  const Flags negative = c0.max(c3) < -outer && c1.max(c2) < -inner;
  return (positive || negative) && x.max(y).max(z) < kLargest;
}

}  // namespace

template <class Scalar>
std::size_t cullByCubic(const Query<Scalar>* queries, std::uint32_t* indices, std::size_t count) {
  std::size_t left = 0;
  Vectors start;
  Vectors end;
  for (std::size_t block = 0; block < count; block += kLanes) {
    const std::size_t used = std::min<std::size_t>(kLanes, count - block);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const Query<Scalar>& query = queries[indices[block + std::min(lane, used - 1)]];
      start.fill(int(lane), query.start);
      end.fill(int(lane), query.end);
    }
    const Flags proved = neverCoplanar(start, end);
    for (std::size_t lane = 0; lane < used; ++lane)
      if (!proved[Eigen::Index(lane)]) indices[left++] = indices[block + lane];
  }
  return left;
}

template std::size_t cullByCubic(const Query<float>*, std::uint32_t*, std::size_t);
template std::size_t cullByCubic(const Query<double>*, std::uint32_t*, std::size_t);

}  // namespace wetcloth::collision
