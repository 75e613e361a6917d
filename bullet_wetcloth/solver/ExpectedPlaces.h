// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/bullet/PackedNodes.h"
#include "bullet_wetcloth/numerics/Lanes.h"
#include "bullet_wetcloth/solver/ExpectedWay.h"

#include <algorithm>
#include <cstddef>

// What ClothGuard does with all nodes of a cloth at once: where it expects them, and whether they are there. For
// runOnBestLanes().

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Which places are where they were expected.
struct ExpectedPlaces {
  static constexpr btScalar kUsedSlack = btScalar(0.9);  // the rest is for rounding

  btScalar* const (&place)[3];
  const PackedNodes::Lane (&from)[3];
  const PackedNodes::Lane (&way)[3];
  const btScalar* slack;
  std::size_t count;
  btScalar age;

  template <class Lanes>
  WETCLOTH_INLINE auto areFound(std::size_t i) const {
    const Lanes limit = load<Lanes>(slack + i) * everywhere<Lanes>(kUsedSlack);
    auto areFound = limit > everywhere<Lanes>(0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Lanes expected =
          load<Lanes>(from[axis].data() + i) + load<Lanes>(way[axis].data() + i) * everywhere<Lanes>(age);
      areFound = areFound & (absolute(load<Lanes>(place[axis] + i) - expected) <= limit);
    }
    return areFound;
  }
};

struct AreAllFound {
  ExpectedPlaces expected;
  bool& result;

  template <class Lanes>
  WETCLOTH_INLINE void run() const {
    auto areFound = everywhere<Lanes>(1) > everywhere<Lanes>(0);
    for (std::size_t i = 0; i < expected.count; i += kLaneCount<Lanes>) {
      areFound = areFound & expected.areFound<Lanes>(i);
    }
    btScalar parts[kLaneCount<Lanes>];
    store(parts, choose(areFound, everywhere<Lanes>(1), everywhere<Lanes>(0)));
    for (const btScalar part : parts) result = result && part > 0;
  }
};

/// 1 for each that is, else 0.
struct MarkFound {
  ExpectedPlaces expected;
  btScalar* mark;

  template <class Lanes>
  WETCLOTH_INLINE void run() const {
    for (std::size_t i = 0; i < expected.count; i += kLaneCount<Lanes>) {
      store(mark + i, choose(expected.areFound<Lanes>(i), everywhere<Lanes>(1), everywhere<Lanes>(0)));
    }
  }
};

/// The largest of a coordinate on either side of a place.
struct FarthestPlace {
  const btScalar* place;
  std::size_t count;
  btScalar away;
  btScalar& farthest;

  template <class Lanes>
  WETCLOTH_INLINE void run() const {
    Lanes most = everywhere<Lanes>(farthest);
    for (std::size_t i = 0; i < count; i += kLaneCount<Lanes>) {
      const Lanes size = absolute(load<Lanes>(place + i) + everywhere<Lanes>(away));
      most = choose(size > most, size, most);
    }
    btScalar parts[kLaneCount<Lanes>];
    store(parts, most);
    for (const btScalar part : parts) farthest = std::max(farthest, part);
  }
};

/// The way in a small step, on average over some of them, of what goes on with its present acceleration, and how far it
/// may leave this way. A node has gone from `before` to `last`, and from there to `place`.
struct ExpectWays {
  btScalar* const (&place)[3];
  const PackedNodes::Lane (&last)[3];
  const PackedNodes::Lane (&before)[3];
  PackedNodes::Lane (&from)[3];
  PackedNodes::Lane (&way)[3];
  btScalar* slack;  // the largest along all axes
  std::size_t count;
  btScalar steps;
  WaySlack slackOf;
  double& restless;  // more of them have the most slack

  template <class Lanes>
  WETCLOTH_INLINE void run() const {
    const Lanes most = everywhere<Lanes>(slackOf.most);
    Lanes atLimit = everywhere<Lanes>(0);
    for (std::size_t i = 0; i < count; i += kLaneCount<Lanes>) {
      Lanes largest = everywhere<Lanes>(0);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const Lanes at = load<Lanes>(last[axis].data() + i);
        const Lanes now = load<Lanes>(place[axis] + i) - at;
        const Lanes earlier = at - load<Lanes>(before[axis].data() + i);
        const Lanes acceleration = now - earlier;
        store(from[axis].data() + i, at);
        store(way[axis].data() + i, slackOf.ahead(now, earlier, steps));
        const Lanes wanted = slackOf.of(now, acceleration);
        largest = choose(wanted > largest, wanted, largest);
      }
      store(slack + i, largest);
      atLimit = atLimit + choose(largest >= most, everywhere<Lanes>(1), everywhere<Lanes>(0));
    }
    btScalar parts[kLaneCount<Lanes>];
    store(parts, atLimit);
    for (const btScalar part : parts) restless += static_cast<double>(part);
  }
};

/// Where nodes were a small step ago, if they went with their present velocity.
struct PlacesBefore {
  const btScalar* place;
  const btScalar* velocity;
  btScalar h;
  btScalar* before;
  std::size_t count;

  template <class Lanes>
  WETCLOTH_INLINE void run() const {
    for (std::size_t i = 0; i < count; i += kLaneCount<Lanes>) {
      store(before + i, load<Lanes>(place + i) - load<Lanes>(velocity + i) * everywhere<Lanes>(h));
    }
  }
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
