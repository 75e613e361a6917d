// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/numerics/Lanes.h"

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// How far nodes may leave the way that a guard expects of them, and the way the present one, on each axis.
struct WaySlack {
  btScalar least;           ///< [m]
  btScalar most;            ///< [m]
  btScalar ofWay;           ///< share
  btScalar ofAcceleration;  ///< share
  btScalar mostBend;        ///< in a small step [m]
  btScalar mostJolt;        ///< in a small step, that is taken to go on [m]; -1: bent() says how a way goes on

  /// What acceleration adds to a way in a small step, within limits [m]: the ways of neighbours differ by its noise,
  /// and what lies still will do so, although gravity would have it fall before it is held.
  /// @param before  the way in the small step before [m]
  template <class Lanes>
  WETCLOTH_INLINE Lanes bent(const Lanes& by, const Lanes& before) const {
    const Lanes cap = everywhere<Lanes>(mostBend);
    const Lanes size = absolute(before);
    const Lanes limit = choose(size < cap, size, cap);
    return choose(by > limit, limit, choose(by < -limit, -limit, by));
  }
  /// The way in a small step as it is on average. Links pull now this way and now that way, so two small steps in turn
  /// tell more than one; a jolt in the present one does not go on.
  /// @param before  the way in the small step before [m]
  template <class Lanes>
  WETCLOTH_INLINE Lanes mean(const Lanes& now, const Lanes& before) const {
    const Lanes cap = everywhere<Lanes>(mostJolt);
    const Lanes half = (now - before) * everywhere<Lanes>(btScalar(0.5));
    return before + choose(half > cap, cap, choose(half < -cap, -cap, half));
  }
  /// The way in a small step, on average over so many.
  template <class Lanes>
  WETCLOTH_INLINE Lanes ahead(const Lanes& now, const Lanes& before, btScalar steps) const {
    if (mostJolt >= 0) return mean(now, before);
    return now + bent((now - before) * everywhere<Lanes>((steps - 1) / 2), before);
  }
  /// @param way  along an axis, in a small step [m]
  /// @param acceleration  by how much that is longer than in the small step before [m]
  template <class Lanes>
  WETCLOTH_INLINE Lanes of(const Lanes& way, const Lanes& acceleration) const {
    const Lanes wanted = everywhere<Lanes>(least) + absolute(way) * everywhere<Lanes>(ofWay) +
                         absolute(acceleration) * everywhere<Lanes>(ofAcceleration);
    const Lanes limit = everywhere<Lanes>(most);
    return choose(wanted < limit, wanted, limit);
  }
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
