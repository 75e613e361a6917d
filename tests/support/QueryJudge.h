// SPDX-License-Identifier: Zlib
#pragma once

// The exact answer to a query as the judge of all others. For builds with Tier::exact only.

#include "tests/support/QueryGeometry.h"

#include <bullet_wetcloth/collision/CoplanarityCubic.h>
#include <bullet_wetcloth/collision/ExactContact.h>

#include <algorithm>

namespace wetcloth_test {

struct Verdict {
  bool meets;
  long double earliest;  ///< bounds of the first time of contact
  long double latest;
};

template <class Scalar>
Verdict verdictOn(Pair pair, const Query<Scalar>& query) {
  const double width = 1e-12;
  const Contact exact = wetcloth::collision::exactContact(pair, converted<double>(query), width);
  return {exact.found, exact.time, std::min(1.0L, exact.time + static_cast<long double>(width))};
}

/// What is wrong with an answer; empty when it is right. For queries whose lengths have squares in the range of double.
template <class Scalar>
std::string faultOf(Tier tier, Pair pair, const Query<Scalar>& query, const Contact& contact, const Verdict& verdict) {
  if (!contact.found) {
    if (verdict.meets) return "misses a contact";
    return contact.time == 0 ? "" : "a time for no contact";
  }
  if (tier == Tier::exact && !verdict.meets) return "false alarm";
  if (!(contact.time >= 0 && contact.time <= 1)) return "time out of range";
  if (!whereInRange(pair, contact)) return "where out of range";
  long double reach = distanceAt(pair, query, contact.time);
  if (verdict.meets) {
    if (contact.time > verdict.latest) return "late";
    // At the time of contact the two are at one point: before, they are as far apart as they come since, at most.
    const long double early = verdict.latest - contact.time;
    reach = std::min(reach, relativeSpeed(pair, query) * early);
    const wetcloth::collision::CoplanarityCubic cubic = wetcloth::collision::coplanarityCubic(query);
    long double slope = 2 * static_cast<long double>(cubic.error), largest = 0;
    for (int k = 0; k < 4; ++k) {
      largest = std::max(largest, std::abs(static_cast<long double>(cubic.bernstein[k])));
      if (k > 0)
        slope = std::max(slope, std::abs(static_cast<long double>(cubic.bernstein[k]) - cubic.bernstein[k - 1]));
    }
    // de Casteljau: three steps of three roundings of numbers no larger than the coefficients.
    const long double rounding = cubic.error + 9 * 0x1p-53L * largest;
    if (std::abs(static_cast<long double>(cubic.value(contact.time))) > rounding + 3 * slope * early)
      return "the four points are not that near a plane";
  }
  if (distanceOf(pair, query, contact.time, contact.where) > reach + whereRounding(query))
    return "where is not nearest";
  return "";
}

}  // namespace wetcloth_test
