// SPDX-License-Identifier: Zlib
#include "command/ccd/NewtonCheck.h"

#include "command/ccd/ComparisonParts.h"

#include <algorithm>
#include <cmath>

namespace command::comparison {
namespace {

template <class Scalar>
Query<double> inDouble(const Query<Scalar>& query) {
  Query<double> result;
  for (int i = 0; i < 4; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      result.start[i][axis] = static_cast<double>(query.start[i][axis]);
      result.end[i][axis] = static_cast<double>(query.end[i][axis]);
    }
  }
  return result;
}

/// What a volume is small against: the product of the longest that the three edges from point 0 get.
double volumeScale(const Motion<double>& motion) {
  double scale = 1;
  for (int i = 0; i < 3; ++i) {
    const Vector<double> end = motion.at(i, 1);
    scale *= std::max(motion.start[i].dot(motion.start[i]), end.dot(end));
  }
  return std::sqrt(scale);
}

/// The cubic is monotone from low to high and has different signs there.
double rootBetween(const PowerCubic<double>& cubic, double low, double high) {
  const bool rises = cubic.value(low) < 0;
  double t = low + 0.5 * (high - low);
  // Bisection alone needs 53 steps.
  for (int step = 0; step < 64; ++step) {
    const double value = cubic.value(t);
    ((value < 0) == rises ? low : high) = t;
    double next = t - value / cubic.slope(t);
    if (!(next > low && next < high)) next = low + 0.5 * (high - low);
    const double change = std::abs(next - t);
    t = next;
    if (change <= 1e-15) break;
  }
  return t;
}

/// Ends of the pieces in which the cubic is monotone, ascending: at most 4.
int monotonePieces(const PowerCubic<double>& cubic, double first, double last, double* ends) {
  double turns[2];
  const int turnCount = quadraticRoots(3 * cubic.a[3], 2 * cubic.a[2], cubic.a[1], turns);
  int count = 0;
  ends[count++] = first;
  for (int i = 0; i < turnCount; ++i) {
    if (turns[i] > ends[count - 1] && turns[i] < last) ends[count++] = turns[i];
  }
  ends[count++] = last;
  return count;
}

}  // namespace

template <class Scalar>
Contact newtonCheck(Pair pair, const Query<Scalar>& query, double tolerance) noexcept {
  const Motion<double> motion(inDouble(query));
  const PowerCubic<double> cubic(motion);
  const double nearZero = tolerance * volumeScale(motion);
  double ends[4];
  const int count = monotonePieces(cubic, -tolerance, 1 + tolerance, ends);
  Contact contact;
  const auto meetAt = [&](double time) {
    return meetInPlane(pair, motion, std::clamp(time, 0., 1.), tolerance, contact);
  };
  for (int i = 0; i < count; ++i) {
    const double value = cubic.value(ends[i]);
    if (std::abs(value) <= nearZero && meetAt(ends[i])) break;
    if (i + 1 == count || (value < 0) == (cubic.value(ends[i + 1]) < 0)) continue;
    if (meetAt(rootBetween(cubic, ends[i], ends[i + 1]))) break;
  }
  return contact;
}

template Contact newtonCheck(Pair pair, const Query<float>& query, double tolerance) noexcept;
template Contact newtonCheck(Pair pair, const Query<double>& query, double tolerance) noexcept;

}  // namespace command::comparison
