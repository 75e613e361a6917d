// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/SmallStep.h"

#include "bullet_wetcloth/numerics/BestLanes.h"
#include "bullet_wetcloth/solver/Parts.h"

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

template <class Lanes>
WETCLOTH_INLINE Lanes clamp(const Lanes& x, const Lanes& limit) {
  const Lanes notAbove = choose(x > limit, limit, x);
  return choose(notAbove < -limit, -limit, notAbove);
}

// How gravity and forces change velocities along one axis.
struct Push {
  const btScalar* inverseMass;
  const btScalar* force;  // or null
  btScalar gravity;       // times the length of the step
  btScalar h;
  btScalar largest;

  template <class Lanes>
  WETCLOTH_INLINE Lanes at(std::size_t i) const {
    const Lanes zero = everywhere<Lanes>(0);
    const Lanes w = load<Lanes>(inverseMass + i);
    const Lanes fall = choose(w > zero, everywhere<Lanes>(gravity), zero);
    if (!force) return fall;
    return fall + clamp<Lanes>(load<Lanes>(force + i) * w * everywhere<Lanes>(h), everywhere<Lanes>(largest));
  }
};

Push pushOf(const SmallStep& step, const MovingNodes& nodes, int axis) {
  return {nodes.inverseMass, nodes.force[axis], step.gravity[axis] * step.h, step.h, step.largestPush};
}

struct Predict {
  const SmallStep& step;
  const MovingNodes& nodes;
  std::size_t begin;
  std::size_t end;

  template <class Lanes>
  WETCLOTH_INLINE void run() const {
    const Lanes h = everywhere<Lanes>(step.h);
    for (int axis = 0; axis < 3; ++axis) {
      const Push push = pushOf(step, nodes, axis);
      const btScalar* const position = nodes.position[axis];
      btScalar* const predicted = nodes.predicted[axis];
      const btScalar* const velocity = nodes.velocity[axis];
      for (std::size_t i = begin; i < end; i += kLaneCount<Lanes>) {
        const Lanes v = load<Lanes>(velocity + i) + push.at<Lanes>(i);
        store(predicted + i, load<Lanes>(position + i) + v * h);
      }
    }
  }
};

// What displaced the nodes has changed their velocities.
template <class Lanes>
WETCLOTH_INLINE Lanes settled(const MovingNodes& nodes, int axis, std::size_t i, const Lanes& perStep,
                              const Lanes& keeps) {
  const Lanes displaced = load<Lanes>(nodes.position[axis] + i) - load<Lanes>(nodes.predicted[axis] + i);
  return (load<Lanes>(nodes.velocity[axis] + i) + displaced * perStep) * keeps;
}

template <bool isFirst>
struct Advance {
  const SmallStep& step;
  const MovingNodes& nodes;
  std::size_t begin;
  std::size_t end;

  template <class Lanes>
  WETCLOTH_INLINE void run() const {
    const Lanes h = everywhere<Lanes>(step.h);
    const Lanes keeps = everywhere<Lanes>(step.keeps);
    const Lanes perStep = everywhere<Lanes>(1 / step.h);
    for (int axis = 0; axis < 3; ++axis) {
      const Push push = pushOf(step, nodes, axis);
      btScalar* const position = nodes.position[axis];
      btScalar* const velocity = nodes.velocity[axis];
      for (std::size_t i = begin; i < end; i += kLaneCount<Lanes>) {
        const Lanes before = isFirst ? load<Lanes>(velocity + i) : settled<Lanes>(nodes, axis, i, perStep, keeps);
        const Lanes v = before + push.at<Lanes>(i);
        const Lanes x = load<Lanes>(position + i) + v * h;
        store(velocity + i, v);
        store(nodes.predicted[axis] + i, x);
        store(position + i, x);
      }
    }
  }
};

struct End {
  const SmallStep& step;
  const MovingNodes& nodes;
  std::size_t begin;
  std::size_t end;

  template <class Lanes>
  WETCLOTH_INLINE void run() const {
    const Lanes keeps = everywhere<Lanes>(step.keeps);
    const Lanes perStep = everywhere<Lanes>(1 / step.h);
    for (int axis = 0; axis < 3; ++axis) {
      for (std::size_t i = begin; i < end; i += kLaneCount<Lanes>) {
        store(nodes.velocity[axis] + i, settled<Lanes>(nodes, axis, i, perStep, keeps));
      }
    }
  }
};

}  // namespace

void SmallStep::predict(const MovingNodes& nodes) const {
  forEachStretch(nodes.count, [&](std::size_t begin, std::size_t end) {
    runOnBestLanes(Predict{*this, nodes, begin, end});
  });
}

void SmallStep::advance(const MovingNodes& nodes, bool isFirst, std::size_t first, std::size_t end) const {
  if (isFirst) {
    runOnBestLanes(Advance<true>{*this, nodes, first, end});
  } else {
    runOnBestLanes(Advance<false>{*this, nodes, first, end});
  }
}

void SmallStep::end(const MovingNodes& nodes) const {
  forEachStretch(nodes.count, [&](std::size_t begin, std::size_t end) {
    runOnBestLanes(End{*this, nodes, begin, end});
  });
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
