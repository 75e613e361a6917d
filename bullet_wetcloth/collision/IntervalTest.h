// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/collision/PointDifferences.h"

#include <algorithm>

namespace wetcloth::collision {

/// Proves, where it can, that the two of a query stay apart (farther than a minimum separation) during an interval of
/// time. Every "true" is a proof; see docs/ccd.md for the lemmas that the constants below come from.
///
/// Valid for vectors whose largest component M is in [2^-100, 2^100]: nothing overflows, and what underflows stays far
/// below kUnderflow, also where the processor flushes denormals to zero, as long as the vectors themselves were not
/// flushed and then scaled up (see ContinuousCheck.cpp).
template <Pair pair>
class IntervalTest {
 public:
  /// The motion at times 0 and 1, which must outlive this.
  IntervalTest(const PointDifferences<pair>& start, const PointDifferences<pair>& end, double minSeparation)
      : m_start(start),
        m_end(end),
        m_magnitude(magnitude<pair>(start.vectors, end.vectors)),
        m_minSeparation(minSeparation) {}

  /// Chooses the interval [t0, t1] that the questions below are about; both multiples of 2^-52.
  void choose(double t0, double t1);

  /// By the axes and the cubic's sign: what ends most intervals, at little cost.
  bool apart() { return apartOnAnAxis() || neverCoplanar(); }
  /// By directions in the plane in which the two are, or nearly are.
  bool apartInPlane() const;

  /// After apart(): Bernstein coefficients on the interval, the inner two times three.
  const double (&cubic() const)[4] { return m_cubic; }
  /// After apart(): by the cubic's sign in the first part of the interval, of length `fraction` of it, in (0, 1).
  bool apartUntil(double fraction) const;
  /// ... and in its last part.
  bool apartInLast(double fraction) const;

 private:
  using Differences = PointDifferences<pair>;

  bool apartOnAnAxis() const;
  bool neverCoplanar();
  bool signedUntil(const double (&coefficients)[4], double fraction) const;
  bool apartAlong(const Vector& direction) const;
  double normalBound() const;
  const Vector* vectorsAt(double t, Differences& storage) const;

  const Differences& m_start;
  const Differences& m_end;
  const Vector m_magnitude;  ///< per axis, at times 0 and 1
  const double m_minSeparation;
  const Vector* m_first = nullptr;  ///< the vectors at t0
  const Vector* m_last = nullptr;   ///< ... and at t1
  Differences m_storage[2];
  bool m_whole = true;  ///< the interval is [0, 1]: its vectors have no error but that of the subtraction
  double m_cubic[4] = {0, 0, 0, 0};
  double m_cubicLimit[2] = {0, 0};  ///< an outer, an inner coefficient beyond this has a proved sign
};

template <>
bool IntervalTest<Pair::vertexFace>::apartInPlane() const;
template <>
bool IntervalTest<Pair::edgeEdge>::apartInPlane() const;

}  // namespace wetcloth::collision
