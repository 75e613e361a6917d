// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/collision/ExactContact.h"

#include "bullet_wetcloth/collision/ExactRoots.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>

namespace wetcloth::collision {

namespace {

using exact::Integer;
using exact::Polynomial;
using exact::Root;
using exact::RootFinder;

// The points before this index belong to the one primitive, the others to the other.
int firstOfOther(Pair pair) { return pair == Pair::vertexFace ? 1 : 2; }

bool isBelow(const double (&points)[4][3], int axis, int split) {
  double largest = points[0][axis];
  for (int i = 1; i < split; ++i) largest = std::max(largest, points[i][axis]);
  return std::all_of(points + split, points + 4, [&](const double* point) { return largest < point[axis]; });
}

bool isAbove(const double (&points)[4][3], int axis, int split) {
  double least = points[0][axis];
  for (int i = 1; i < split; ++i) least = std::min(least, points[i][axis]);
  return std::all_of(points + split, points + 4, [&](const double* point) { return least > point[axis]; });
}

// Differences of coordinates are linear in time: what is apart in the same order at both ends is apart in between.
bool staysApart(const Query<double>& query, int split) {
  for (int axis = 0; axis < 3; ++axis) {
    if (isBelow(query.start, axis, split) && isBelow(query.end, axis, split)) return true;
    if (isAbove(query.start, axis, split) && isAbove(query.end, axis, split)) return true;
  }
  return false;
}

// mantissa * 2^exponent
struct Dyadic {
  std::int64_t mantissa;
  int exponent;
};

// Bit by bit: a processor that takes denormal numbers for 0 does not get to see them.
Dyadic dyadic(double value) {
  static_assert(std::numeric_limits<double>::is_iec559);
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  constexpr std::uint64_t hidden = std::uint64_t(1) << 52;
  const std::uint64_t fraction = bits & (hidden - 1);
  const int biased = static_cast<int>(bits >> 52 & 2047);
  const auto magnitude = static_cast<std::int64_t>(biased == 0 ? fraction : fraction | hidden);
  return {bits >> 63 ? -magnitude : magnitude, std::max(biased, 1) - 1075};
}

int trailingZeros(std::int64_t value) {
  int zeros = 0;
  for (int step = 32; step > 0; step /= 2) {
    if (value & ((std::int64_t(1) << step) - 1)) continue;
    value >>= step;
    zeros += step;
  }
  return zeros;
}

// All coordinates times the one power of two that makes them integers, and small ones.
void toIntegers(const Query<double>& query, Integer (&points)[2][4][3]) {
  // Not `(i < 12 ? start : end)[...]`: g++ 12 with -fsanitize=undefined reads other numbers there.
  const double(*const ends[])[3] = {query.start, query.end};
  Dyadic numbers[24];
  int lowest = std::numeric_limits<int>::max();
  for (int i = 0; i < 24; ++i) {
    numbers[i] = dyadic(ends[i / 12][i % 12 / 3][i % 3]);
    const Dyadic& number = numbers[i];
    if (number.mantissa != 0) lowest = std::min(lowest, number.exponent + trailingZeros(number.mantissa));
  }
  for (int i = 0; i < 24; ++i) {
    const auto [mantissa, exponent] = numbers[i];
    if (mantissa == 0) continue;
    Integer& point = points[i / 12][i % 12 / 3][i % 3];
    if (exponent >= lowest) {
      point = mantissa;
      point <<= exponent - lowest;
    } else {
      point = mantissa / (std::int64_t(1) << (lowest - exponent));
    }
  }
}

// The two of a query, as seen from point 0.
//
// What decides where the four points are in one plane are the oriented areas that every three of them span, as seen
// along a coordinate axis: A_i without point i. They are the coefficients of the points' affine dependency,
//   A_1 p1 + A_2 p2 + A_3 p3 = A_0 p0,   A_1 + A_2 + A_3 = A_0,
// and a point is in a triangle, or an edge crosses an edge, where the coefficients on either side of
//   A_1 p1 + A_2 p2 + A_3 p3 = A_0 p0   or   A_0 p0 - A_1 p1 = A_2 p2 + A_3 p3
// are all of one sign. docs/ccd.md has the proof, for degenerate primitives too.
class Meeting {
 public:
  Meeting(Pair pair, const Query<double>& query);

  /// 0 when and only when the four points are in one plane.
  Polynomial volume() const;
  /// Whether the two meet at this time, at which the volume must be 0.
  bool isAt(Root& time);
  /// The first time of a contact, from below, where the volume is always 0.
  Contact firstInOnePlane(double tolerance);

 private:
  struct Areas {
    Polynomial part[4];
    bool areKnown = false;
  };

  Polynomial cross(int i, int j, int axis) const;
  const Areas& areas(int axis);
  Polynomial difference(int i, int j, int axis) const;
  bool overlap(Root& time, int axis) const;
  void improve(Contact& first, const Polynomial& candidate, double tolerance);

  int m_split;
  int m_partCount;
  Integer m_start[4][3];
  Integer m_motion[4][3];
  Areas m_areas[3];
};

Meeting::Meeting(Pair pair, const Query<double>& query)
    : m_split(firstOfOther(pair)), m_partCount(pair == Pair::vertexFace ? 3 : 4) {
  Integer points[2][4][3];
  toIntegers(query, points);
  for (int i = 1; i < 4; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      m_start[i][axis] = points[0][i][axis] - points[0][0][axis];
      m_motion[i][axis] = points[1][i][axis] - points[1][0][axis] - m_start[i][axis];
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    Polynomial& first = m_areas[axis].part[0];
    first = m_split == 1 ? cross(2, 3, axis) : cross(3, 2, axis);
  }
}

Polynomial Meeting::cross(int i, int j, int axis) const {
  const int y = (axis + 1) % 3;
  const int z = (axis + 2) % 3;
  Polynomial product;
  product.c[0] = m_start[i][y] * m_start[j][z] - m_start[i][z] * m_start[j][y];
  product.c[1] = m_start[i][y] * m_motion[j][z] - m_start[i][z] * m_motion[j][y] + m_motion[i][y] * m_start[j][z] -
                 m_motion[i][z] * m_start[j][y];
  product.c[2] = m_motion[i][y] * m_motion[j][z] - m_motion[i][z] * m_motion[j][y];
  return product;
}

// Those that must be of one sign: A_1, A_2, A_3 or -A_1, A_2, A_3, A_0.
const Meeting::Areas& Meeting::areas(int axis) {
  Areas& areas = m_areas[axis];
  if (areas.areKnown) return areas;
  areas.part[1] = cross(3, 1, axis);
  areas.part[2] = cross(1, 2, axis);
  if (m_partCount == 4)
    for (int i = 0; i < 3; ++i) areas.part[3].c[i] = areas.part[1].c[i] + areas.part[2].c[i] - areas.part[0].c[i];
  areas.areKnown = true;
  return areas;
}

Polynomial Meeting::volume() const {
  Polynomial volume;
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < 3; ++i) {
      volume.c[i] += m_start[1][axis] * m_areas[axis].part[0].c[i];
      volume.c[i + 1] += m_motion[1][axis] * m_areas[axis].part[0].c[i];
    }
  }
  return volume;
}

Polynomial Meeting::difference(int i, int j, int axis) const {
  return {{m_start[j][axis] - m_start[i][axis], m_motion[j][axis] - m_motion[i][axis], 0, 0}};
}

bool Meeting::overlap(Root& time, int axis) const {
  bool someBelow = false;
  bool someAbove = false;
  for (int i = 0; i < m_split; ++i) {
    for (int j = m_split; j < 4; ++j) {
      const int sign = time.sign(difference(i, j, axis));
      if (sign == 0) return true;
      (sign < 0 ? someBelow : someAbove) = true;
    }
  }
  return someBelow && someAbove;
}

bool Meeting::isAt(Root& time) {
  for (int axis = 0; axis < 3; ++axis) {
    const Areas& parts = areas(axis);
    int common = 0;
    for (int i = 0; i < m_partCount; ++i) {
      const int sign = time.sign(parts.part[i]);
      if (sign != 0 && sign == -common) return false;
      if (sign != 0) common = sign;
    }
    if (common != 0) return true;
  }
  // All four points are on one line.
  return overlap(time, 0) && overlap(time, 1) && overlap(time, 2);
}

void Meeting::improve(Contact& first, const Polynomial& candidate, double tolerance) {
  RootFinder roots(candidate);
  while (auto root = roots.next()) {
    const double time = root->fromBelow(tolerance);
    if (first.found && time >= first.time) return;
    if (!isAt(*root)) continue;
    first.found = true;
    first.time = time;
    return;
  }
}

// A contact that begins after time 0 begins with a vertex of the one on an edge or a vertex of the other: strictly
// inside, or where two edges cross, they would have met before, having been in the same plane. So the area of that
// vertex and edge becomes 0 then, or, if it always is, a coordinate in which the vertex differs from an end of the
// edge.
Contact Meeting::firstInOnePlane(double tolerance) {
  Contact first;
  Root zero(0, 1);
  first.found = isAt(zero);
  if (first.found) return first;
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < m_partCount; ++i) improve(first, areas(axis).part[i], tolerance);
    for (int i = 0; i < m_split; ++i)
      for (int j = m_split; j < 4; ++j) improve(first, difference(i, j, axis), tolerance);
  }
  return first;
}

}  // namespace

Contact exactContact(Pair pair, const Query<double>& query, double tolerance) {
  if (staysApart(query, firstOfOther(pair))) return {};
  Meeting meeting(pair, query);
  const Polynomial volume = meeting.volume();
  if (volume.isZero()) return meeting.firstInOnePlane(tolerance);
  Contact contact;
  RootFinder roots(volume);
  while (auto root = roots.next()) {
    if (!meeting.isAt(*root)) continue;
    contact.found = true;
    contact.time = root->fromBelow(tolerance);
    break;
  }
  return contact;
}

}  // namespace wetcloth::collision
