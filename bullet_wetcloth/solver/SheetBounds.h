// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/numerics/Lanes.h"
#include "bullet_wetcloth/numerics/Quad.h"

#include <limits>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// A box along the axes; empty at first.
struct GuardBox {
  Quad low = everywhere<Quad>(std::numeric_limits<btScalar>::infinity());
  Quad high = everywhere<Quad>(-std::numeric_limits<btScalar>::infinity());

  bool isEmpty() const { return high[0] < low[0]; }
  WETCLOTH_INLINE void include(const Quad& point) {
    low = lesser(point, low);
    high = greater(point, high);
  }
  WETCLOTH_INLINE void include(const GuardBox& other) {
    low = lesser(other.low, low);
    high = greater(other.high, high);
  }
  WETCLOTH_INLINE void grow(btScalar by) {
    low = low - everywhere<Quad>(by);
    high = high + everywhere<Quad>(by);
  }
  WETCLOTH_INLINE bool overlaps(const GuardBox& other) const {
    constexpr unsigned kAxes = 7;
    return (bitsOf((low > other.high) | (other.low > high)) & kAxes) == 0;
  }
};

/// Between which vectors those along the rows (u) and the columns (v) of a rectangle of a grid lie.
struct SheetBounds {
  GuardBox u;
  GuardBox v;

  void include(const SheetBounds& other) {
    u.include(other.u);
    v.include(other.v);
  }
  /// True: a rectangle of triangles whose sides along rows and columns are such vectors does not meet itself. See
  /// docs/guard.md for the proof.
  bool areOfASheetThatCannotMeetItself() const;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
