// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Export.h"
#include "bullet_wetcloth/collision/Query.h"

#include <cstddef>

namespace wetcloth::collision {

/// Three ways to answer a query. None of them ever misses a contact, as long as arithmetic rounds to nearest (the
/// default); a thread may flush denormals to zero.
enum class Tier {
  /// Batches are culled in single precision, several queries at a time, with a proved error bound; what is left goes
  /// to `conservative`. Same guarantee as `conservative`; a single query is answered by that tier.
  fast,
  /// Floating point with proved error bounds. "No contact" is a proof. "Contact" means contact, or one that could not
  /// be excluded within the tolerance, the rounding and the budget: false alarms are possible.
  conservative,
  /// `conservative`, then a floating-point proof of contact, then exact integer arithmetic for what neither decided:
  /// no misses and no false alarms for finite points. Needs Boost.Multiprecision when this library is built.
  exact
};

/// How closely to look, and what counts as meeting.
struct CheckSettings {
  /// Width of the time interval in which a contact is no longer looked for more closely, a fraction of the motion, in
  /// [1e-12, 1]. Smaller means a later (closer) reported time and fewer false alarms.
  double tolerance = 1e-6;
  /// Worst-case work of one query: so many time intervals are looked at, then the answer is "contact" (Tier::exact then
  /// goes on to exact arithmetic, which this does not limit). >= 1.
  int maxIntervals = 256;
  /// Thickness: two that come as near as this meet, in the unit of the points, finite and >= 0. With Tier::exact only
  /// 0.
  double minSeparation = 0;
};

/// Continuous collision of moving points, triangles and edges. Points that are not finite answer "contact" at time 0.
///
/// Allocates nothing, but for Tier::exact on coordinates of such different sizes that its integers outgrow 4096 bits;
/// if memory runs out there, the program ends.
class WETCLOTH_COLLISION_EXPORT ContinuousCheck {
 public:
  /// Throws std::invalid_argument naming the field and the value when a setting is out of range, and
  /// std::runtime_error for Tier::exact in a build without it.
  explicit ContinuousCheck(Tier tier = Tier::conservative, const CheckSettings& settings = {});

  /// True when this build has Tier::exact.
  static bool hasExact();

  /// Scalar is float or double; both have the same guarantees.
  template <class Scalar>
  Contact operator()(Pair pair, const Query<Scalar>& query) const noexcept;

  /// Answers `count` queries into contacts[0 .. count - 1].
  template <class Scalar>
  void operator()(Pair pair, const Query<Scalar>* queries, std::size_t count, Contact* contacts) const noexcept;

  /// As given.
  Tier tier() const { return m_tier; }
  /// As given.
  const CheckSettings& settings() const { return m_settings; }

 private:
  Tier m_tier;
  CheckSettings m_settings;
};

}  // namespace wetcloth::collision
