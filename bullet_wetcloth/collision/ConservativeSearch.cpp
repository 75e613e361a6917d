// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/collision/ConservativeSearch.h"

#include "bullet_wetcloth/collision/IntervalTest.h"

#include <algorithm>

namespace wetcloth::collision {
namespace {

/// A root in (0, 1) of a cubic whose ends differ in sign, by Newton's method kept inside a bracket. Only a guess of
/// where to divide: nothing depends on how good it is.
double guessRoot(const double (&scaled)[4]) {
  const double c[4] = {scaled[0], scaled[1] / 3, scaled[2] / 3, scaled[3]};
  double low = 0;
  double high = 1;
  double t = c[0] / (c[0] - c[3]);
  for (int i = 0; i < 10; ++i) {
    const double s = 1 - t;
    const double value = s * (s * (s * c[0] + 3 * t * c[1]) + 3 * t * t * c[2]) + t * t * t * c[3];
    const double slope = 3 * (s * s * (c[1] - c[0]) + 2 * s * t * (c[2] - c[1]) + t * t * (c[3] - c[2]));
    ((value > 0) == (c[0] > 0) ? low : high) = t;
    const double next = t - value / slope;
    const double last = t;
    t = next > low && next < high ? next : 0.5 * (low + high);
    if (std::abs(t - last) < 1e-5) break;  // its square is left, where the root is a simple one
  }
  return t;
}

/// The nearest multiple of 2^-52, for t in [0, 1]: its difference from 1 is exact.
double onGrid(double t) { return (t + 1) - 1; }

struct Interval {
  enum class Kind {
    plain,
    root,       ///< cut out around a root, no wider than the tolerance: the cubic's sign proves nothing in it
    besideRoot  ///< dividing at a root has just been tried: now in the middle
  };
  double from;
  double to;
  Kind kind;
};

/// Intervals that are still to be looked at, the earliest on top. A division leaves at most two more, and an interval
/// is halved at least every second time: three for each halving, down to 1e-12, is about 120.
class Pending {
 public:
  Pending() { push({0, 1, Interval::Kind::plain}); }
  bool empty() const { return m_count == 0; }
  void push(const Interval& interval) {
    if (interval.from < interval.to) m_intervals[m_count++] = interval;
  }
  Interval pop() { return m_intervals[--m_count]; }

 private:
  Interval m_intervals[160];
  int m_count = 0;
};

/// Cuts out a short interval around the guessed root, so that what is before and after it has none: most often the
/// cubic proves that at once.
template <Pair pair>
void divideAtRoot(Pending& pending, const Interval& interval, const IntervalTest<pair>& test, double tolerance) {
  const double width = interval.to - interval.from;
  const double middle = interval.from + width * guessRoot(test.cubic());
  const double before = std::max(interval.from, onGrid(middle - 0.45 * tolerance));
  const double after = std::min(interval.to, onGrid(middle + 0.45 * tolerance));
  // Rounded up: the part that the cubic speaks for must cover the interval that is left out.
  constexpr double kUp = 1 + 0x1p-50;
  const bool freeAfter = after == interval.to || test.apartInLast((interval.to - after) / width * kUp);
  const bool freeBefore = before == interval.from || test.apartUntil((before - interval.from) / width * kUp);
  if (!freeAfter) pending.push({after, interval.to, Interval::Kind::besideRoot});
  // A poor guess leaves the root beside the piece, and then its sign may prove it free after all.
  pending.push({before, after, freeAfter && freeBefore ? Interval::Kind::root : Interval::Kind::besideRoot});
  if (!freeBefore) pending.push({interval.from, before, Interval::Kind::besideRoot});
}

void halve(Pending& pending, const Interval& interval) {
  const double middle = onGrid(0.5 * (interval.from + interval.to));
  pending.push({middle, interval.to, Interval::Kind::plain});
  pending.push({interval.from, middle, Interval::Kind::plain});
}

}  // namespace

template <Pair pair>
Suspicion firstSuspicion(const PointDifferences<pair>& start, const PointDifferences<pair>& end,
                         const CheckSettings& settings) {
  IntervalTest<pair> test(start, end, settings.minSeparation);
  Pending pending;
  for (int looked = 0; !pending.empty(); ++looked) {
    const Interval interval = pending.pop();
    if (looked == settings.maxIntervals) return {true, interval.from, 1};
    test.choose(interval.from, interval.to);
    if (interval.kind != Interval::Kind::root && test.apart()) continue;
    const double width = interval.to - interval.from;
    const bool narrow = width <= settings.tolerance;
    const bool divisible = width > 4 * settings.tolerance && interval.kind == Interval::Kind::plain;
    if (divisible && (test.cubic()[0] > 0) != (test.cubic()[3] > 0)) {
      divideAtRoot(pending, interval, test, settings.tolerance);
      continue;
    }
    if (test.apartInPlane()) continue;
    if (narrow) return {true, interval.from, interval.to};
    halve(pending, interval);
  }
  return {};
}

template Suspicion firstSuspicion(const PointDifferences<Pair::vertexFace>&, const PointDifferences<Pair::vertexFace>&,
                                  const CheckSettings&);
template Suspicion firstSuspicion(const PointDifferences<Pair::edgeEdge>&, const PointDifferences<Pair::edgeEdge>&,
                                  const CheckSettings&);

}  // namespace wetcloth::collision
