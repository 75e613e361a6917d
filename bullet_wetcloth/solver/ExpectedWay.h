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
