// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/collision/ContinuousCheck.h"

#include "bullet_wetcloth/collision/AxisCull.h"
#include "bullet_wetcloth/collision/ConservativeSearch.h"
#include "bullet_wetcloth/collision/ContactProof.h"
#include "bullet_wetcloth/collision/CubicCull.h"
#include "bullet_wetcloth/collision/ExactContact.h"
#include "bullet_wetcloth/collision/Nearest.h"
#include "bullet_wetcloth/collision/ToDouble.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>

namespace wetcloth::collision {
namespace {

template <class Value>
[[noreturn]] void reject(const std::string& field, const Value& value, const std::string& allowed) {
  std::ostringstream text;
  text << field << " = " << value << ": must be " << allowed;
  throw std::invalid_argument(text.str());
}

template <class Scalar>
bool isFinite(const Query<Scalar>& query) {
  // x * 0 is 0 for what is finite and not a number for all else. Six sums, because one would wait for itself.
  Scalar sums[2][3] = {};
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 3; ++k) {
      sums[0][k] += query.start[i][k] * 0;
      sums[1][k] += query.end[i][k] * 0;
    }
  }
  return sums[0][0] + sums[0][1] + sums[0][2] + sums[1][0] + sums[1][1] + sums[1][2] == 0;
}

/// Whether the processor, as this thread has set it, takes denormal numbers for 0.
bool flushesDenormals() {
  const volatile double least = std::numeric_limits<double>::min();
  const volatile double half = 0.5 * least;
  return half == 0;
}

Contact contactAt(double time) {
  Contact contact;
  contact.found = true;
  contact.time = time;
  return contact;
}

/// The motion in a unit of length of its own, a power of two, in which its largest component is in [1/2, 1).
template <Pair pair>
struct Scaled {
  PointDifferences<pair> start;
  PointDifferences<pair> end;
  double minSeparation;

  void by(int exponent) {
    // Not by a factor: that of the smallest denormals is too large for a double.
    const auto scale = [exponent](double component) { return std::ldexp(component, exponent); };
    for (PointDifferences<pair>* at : {&start, &end}) {
      for (Vector& vector : at->vectors) vector = vector.unaryExpr(scale);
    }
    minSeparation = std::ldexp(minSeparation, exponent);
  }
};

/// The tier's answer for finite points. A motion that is out of the search's range is scaled into it.
template <Pair pair>
class Answer {
 public:
  Answer(const Query<double>& query, Tier tier, const CheckSettings& settings)
      : m_query(query), m_tier(tier), m_settings(settings) {}

  Contact operator()() const {
    Scaled<pair> motion = {differences<pair>(m_query.start), differences<pair>(m_query.end), m_settings.minSeparation};
    const double largest = magnitude<pair>(motion.start.vectors, motion.end.vectors).maxCoeff();
    if (!std::isfinite(largest)) return outOfRange();
    // What flushing took from the differences would be scaled up, beyond what the bounds have room for.
    if (largest < 0x1p-300 && flushesDenormals()) return outOfRange();
    // Points 0 and 1, and those of the other primitive, are no farther from each other than this: or all one place.
    if (largest <= 0.5 * m_settings.minSeparation || largest == 0) return contactAt(0);
    if (largest < 0x1p-100 || largest > 0x1p100) motion.by(-std::ilogb(largest) - 1);
    return search(motion);
  }

 private:
  Contact search(const Scaled<pair>& motion) const {
    CheckSettings settings = m_settings;
    settings.minSeparation = motion.minSeparation;
    const Suspicion suspicion = firstSuspicion(motion.start, motion.end, settings);
    if (!suspicion.found) return {};
    Contact contact = contactAt(suspicion.from);
    if (m_tier == Tier::exact && !provedContact(motion.start, motion.end, suspicion.from, suspicion.to)) {
      contact = exactly();
      if (!contact.found) return contact;
      contact.time = std::max(contact.time, suspicion.from);
    }
    const auto where = nearest(blend(motion.start, motion.end, contact.time));
    contact.where[0] = where[0];
    contact.where[1] = where[1];
    return contact;
  }

  /// Differences beyond what double can tell: only exact arithmetic can.
  Contact outOfRange() const { return m_tier == Tier::exact ? exactly() : contactAt(0); }

  Contact exactly() const {
#ifdef WETCLOTH_EXACT_COLLISION
    return exactContact(pair, m_query, m_settings.tolerance);
#else
    return contactAt(0);
#endif
  }

  const Query<double>& m_query;
  const Tier m_tier;
  const CheckSettings& m_settings;
};

template <Pair pair, class Scalar>
Contact answerUnculled(const Query<Scalar>& query, Tier tier, const CheckSettings& settings) {
  return isFinite(query) ? Answer<pair>(toDouble(query), tier, settings)() : contactAt(0);
}

template <Pair pair, class Scalar>
Contact answer(const Query<Scalar>& query, Tier tier, const CheckSettings& settings) {
  if (settings.minSeparation == 0 && apartOnAnAxis<pair>(query)) return {};
  return answerUnculled<pair>(query, tier, settings);
}

/// Culled on the axes, then in single precision, then one by one; in blocks, so that the list of those that are left
/// has its place on the stack.
template <Pair pair, class Scalar>
void answerBatch(const Query<Scalar>* queries, std::size_t count, Contact* contacts, Tier tier,
                 const CheckSettings& settings) {
  constexpr std::size_t kBlock = 256;
  std::uint32_t indices[kBlock];
  for (std::size_t first = 0; first < count; first += kBlock) {
    const Query<Scalar>* block = queries + first;
    std::size_t left = 0;
    for (std::size_t i = 0; i < std::min(kBlock, count - first); ++i) {
      contacts[first + i] = Contact();
      if (!apartOnAnAxis<pair>(block[i])) indices[left++] = std::uint32_t(i);
    }
    left = cullByCubic(block, indices, left);
    for (std::size_t i = 0; i < left; ++i)
      contacts[first + indices[i]] = answerUnculled<pair>(block[indices[i]], tier, settings);
  }
}

}  // namespace

ContinuousCheck::ContinuousCheck(Tier tier, const CheckSettings& settings) : m_tier(tier), m_settings(settings) {
  if (!(settings.tolerance >= 1e-12 && settings.tolerance <= 1))
    reject("tolerance", settings.tolerance, "in [1e-12, 1]");
  if (settings.maxIntervals < 1) reject("maxIntervals", settings.maxIntervals, ">= 1");
  if (!(std::isfinite(settings.minSeparation) && settings.minSeparation >= 0))
    reject("minSeparation", settings.minSeparation, "finite and >= 0");
  if (tier != Tier::exact) return;
  if (settings.minSeparation > 0) reject("minSeparation", settings.minSeparation, "0 with Tier::exact");
  if (!hasExact()) throw std::runtime_error("Tier::exact: built without Boost.Multiprecision (Debian: libboost-dev)");
}

bool ContinuousCheck::hasExact() {
#ifdef WETCLOTH_EXACT_COLLISION
  return true;
#else
  return false;
#endif
}

template <class Scalar>
Contact ContinuousCheck::operator()(Pair pair, const Query<Scalar>& query) const noexcept {
  return pair == Pair::vertexFace ? answer<Pair::vertexFace>(query, m_tier, m_settings)
                                  : answer<Pair::edgeEdge>(query, m_tier, m_settings);
}

template <class Scalar>
void ContinuousCheck::operator()(Pair pair, const Query<Scalar>* queries, std::size_t count,
                                 Contact* contacts) const noexcept {
  // The culls know no separation, and the tier `conservative` means double precision.
  if (m_tier == Tier::conservative || m_settings.minSeparation > 0) {
    for (std::size_t i = 0; i < count; ++i) contacts[i] = (*this)(pair, queries[i]);
    return;
  }
  if (pair == Pair::vertexFace) {
    answerBatch<Pair::vertexFace>(queries, count, contacts, m_tier, m_settings);
  } else {
    answerBatch<Pair::edgeEdge>(queries, count, contacts, m_tier, m_settings);
  }
}

template Contact ContinuousCheck::operator()(Pair, const Query<float>&) const noexcept;
template Contact ContinuousCheck::operator()(Pair, const Query<double>&) const noexcept;
template void ContinuousCheck::operator()(Pair, const Query<float>*, std::size_t, Contact*) const noexcept;
template void ContinuousCheck::operator()(Pair, const Query<double>*, std::size_t, Contact*) const noexcept;

}  // namespace wetcloth::collision
