// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/numerics/TriangleDrag.h"

#include "bullet_wetcloth/numerics/InstructionSet.h"
#include "bullet_wetcloth/numerics/Lanes.h"

#include <cmath>
#include <cstddef>
#include <limits>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

using Block = TriangleBlocks::Block;
constexpr std::size_t kSize = TriangleBlocks::kSize;
constexpr std::size_t kLanes = TriangleBlocks::kLanes;
static_assert(kLanes % kLaneCount<WideLanes> == 0, "blocks are whole numbers of lanes");

// Of one corner of each triangle: where a run's are, or what was gathered.
struct Corner {
  const btScalar* position[3];
  const btScalar* relative[3];
  const btScalar* specificArea;
};

// What the triangles of a block come to.
struct Pushes {
  btScalar normal[3][kSize];   // N, twice the area along the normal; 0 where there is no triangle
  btScalar towards[3][kSize];  // of each corner: R (N . u) / (6 |N|)
  btScalar drag[kSize];        // R |N| / 6
};

// N . u of one corner.
template <class Lanes, bool hasFlow>
WETCLOTH_INLINE Lanes along(const Corner& corner, const TriangleDrag::Flow* flow, std::size_t f, const Lanes& nx,
                            const Lanes& ny, const Lanes& nz) {
  Lanes relative[3];
  for (int axis = 0; axis < 3; ++axis) {
    relative[axis] = load<Lanes>(corner.relative[axis] + f);
    if constexpr (hasFlow) relative[axis] = relative[axis] + load<Lanes>((*flow)[axis] + f);
  }
  return nx * relative[0] + ny * relative[1] + nz * relative[2];
}

template <class Lanes>
WETCLOTH_INLINE Lanes edge(const Corner& to, const Corner& from, int axis, std::size_t f) {
  return load<Lanes>(to.position[axis] + f) - load<Lanes>(from.position[axis] + f);
}

template <class Lanes, bool hasFlow>
WETCLOTH_INLINE void push(const Corner (&corners)[3], const btScalar* isTaken, const TriangleDrag::Flow* flow,
                          const FluidResistance& resistance, std::size_t lanes, Pushes& out) {
  using Limits = std::numeric_limits<btScalar>;
  const Lanes linear = everywhere<Lanes>(resistance.linear / 6);
  const Lanes quadratic = everywhere<Lanes>(resistance.quadratic / 9);
  const Lanes damping = everywhere<Lanes>(4 * resistance.dt * resistance.quadratic / 9);
  const Lanes zero = everywhere<Lanes>(0);
  const auto& [a, b, c] = corners;
  for (std::size_t f = 0; f < lanes; f += kLaneCount<Lanes>) {
    const Lanes abx = edge<Lanes>(b, a, 0, f), aby = edge<Lanes>(b, a, 1, f), abz = edge<Lanes>(b, a, 2, f);
    const Lanes acx = edge<Lanes>(c, a, 0, f), acy = edge<Lanes>(c, a, 1, f), acz = edge<Lanes>(c, a, 2, f);
    const Lanes nx = aby * acz - abz * acy;
    const Lanes ny = abz * acx - abx * acz;
    const Lanes nz = abx * acy - aby * acx;
    const Lanes squared = nx * nx + ny * ny + nz * nz;
    const Lanes atA = along<Lanes, hasFlow>(a, flow, f, nx, ny, nz);
    const Lanes atB = along<Lanes, hasFlow>(b, flow, f, nx, ny, nz);
    const Lanes atC = along<Lanes, hasFlow>(c, flow, f, nx, ny, nz);
    // A triangle without area feels nothing.
    const auto isThere = (load<Lanes>(isTaken + f) > zero) & (squared >= everywhere<Lanes>(Limits::min())) &
                         (squared <= everywhere<Lanes>(Limits::max()));
    // R / (6 |N|) with dampedSpeed() for the mean of the corners' speeds and specific areas, so arranged that one
    // division does; thirds are in the constants.
    const Lanes speed = absolute(atA + atB + atC);
    const Lanes specificArea =
        load<Lanes>(a.specificArea + f) + load<Lanes>(b.specificArea + f) + load<Lanes>(c.specificArea + f);
    const Lanes length = squareRoot(squared);
    const Lanes both = length + squareRoot(squared + damping * specificArea * speed * length);
    const Lanes share = (linear * both + quadratic * speed) / choose(isThere, length * both, everywhere<Lanes>(1));
    store(out.normal[0] + f, choose(isThere, nx, zero));
    store(out.normal[1] + f, choose(isThere, ny, zero));
    store(out.normal[2] + f, choose(isThere, nz, zero));
    store(out.towards[0] + f, choose(isThere, atA * share, zero));
    store(out.towards[1] + f, choose(isThere, atB * share, zero));
    store(out.towards[2] + f, choose(isThere, atC * share, zero));
    store(out.drag + f, choose(isThere, share * squared, zero));
  }
}

WETCLOTH_INLINE Corner stretch(const TriangleDrag::Nodes& nodes, int first) {
  Corner corner;
  for (int axis = 0; axis < 3; ++axis) {
    corner.position[axis] = nodes.position[axis] + first;
    corner.relative[axis] = nodes.relative[axis] + first;
  }
  corner.specificArea = nodes.specificArea + first;
  return corner;
}

// A corner's nodes are all different, so that several can be added to at once.
template <class Lanes>
WETCLOTH_INLINE void addToStretch(const Pushes& pushes, int corner, int first, std::size_t lanes,
                                  const TriangleDrag::Nodes& nodes) {
  const btScalar* const towards = pushes.towards[corner];
  for (int axis = 0; axis < 3; ++axis) {
    btScalar* const force = nodes.force[axis] + first;
    const btScalar* const normal = pushes.normal[axis];
    for (std::size_t f = 0; f < lanes; f += kLaneCount<Lanes>) {
      store(force + f, load<Lanes>(force + f) + load<Lanes>(normal + f) * load<Lanes>(towards + f));
    }
  }
  btScalar* const drag = nodes.drag + first;
  for (std::size_t f = 0; f < lanes; f += kLaneCount<Lanes>)
    store(drag + f, load<Lanes>(drag + f) + load<Lanes>(pushes.drag + f));
}

template <class Lanes>
WETCLOTH_INLINE void addRun(const TriangleBlocks& triangles, const Block& block, const FluidResistance& resistance,
                            const TriangleDrag::Flow* flow, const TriangleDrag::Nodes& nodes) {
  Pushes pushes;
  const std::size_t lanes = block.lanes / kLanes * kLanes;
  const Corner corners[3] = {stretch(nodes, block.first[0]), stretch(nodes, block.first[1]),
                             stretch(nodes, block.first[2])};
  if (flow) {
    push<Lanes, true>(corners, triangles.isTaken(block), flow, resistance, lanes, pushes);
  } else {
    push<Lanes, false>(corners, triangles.isTaken(block), flow, resistance, lanes, pushes);
  }
  for (int k = 0; k < 3; ++k) addToStretch<Lanes>(pushes, k, block.first[static_cast<std::size_t>(k)], lanes, nodes);
}

struct Gathered {
  btScalar position[3][kSize];
  btScalar relative[3][kSize];
  btScalar specificArea[kSize];
};

template <class Lanes>
WETCLOTH_INLINE void addGathered(const TriangleBlocks& triangles, const Block& block, const FluidResistance& resistance,
                                 const TriangleDrag::Flow* flow, const TriangleDrag::Nodes& nodes) {
  Gathered gathered[3];
  Pushes pushes;
  const std::size_t lanes = block.lanes / kLanes * kLanes;
  for (std::size_t f = 0; f < lanes; ++f) {
    const TriangleBlocks::Triangle corners = triangles.corners(block, f);
    for (std::size_t k = 0; k < 3; ++k) {
      for (int axis = 0; axis < 3; ++axis) {
        gathered[k].position[axis][f] = nodes.position[axis][corners[k]];
        gathered[k].relative[axis][f] = nodes.relative[axis][corners[k]];
      }
      gathered[k].specificArea[f] = nodes.specificArea[corners[k]];
    }
  }
  Corner at[3];
  for (std::size_t k = 0; k < 3; ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      at[k].position[axis] = gathered[k].position[axis];
      at[k].relative[axis] = gathered[k].relative[axis];
    }
    at[k].specificArea = gathered[k].specificArea;
  }
  if (flow) {
    push<Lanes, true>(at, triangles.isTaken(block), flow, resistance, lanes, pushes);
  } else {
    push<Lanes, false>(at, triangles.isTaken(block), flow, resistance, lanes, pushes);
  }
  for (std::size_t f = 0; f < lanes; ++f) {
    const TriangleBlocks::Triangle corners = triangles.corners(block, f);
    for (std::size_t k = 0; k < 3; ++k) {
      for (int axis = 0; axis < 3; ++axis) {
        nodes.force[axis][corners[k]] += pushes.normal[axis][f] * pushes.towards[k][f];
      }
      nodes.drag[corners[k]] += pushes.drag[f];
    }
  }
}

template <class Lanes>
WETCLOTH_INLINE void addBlock(const TriangleBlocks& triangles, const Block& block, const FluidResistance& resistance,
                              const TriangleDrag::Flow* flow, const TriangleDrag::Nodes& nodes) {
  if (block.isRun) {
    addRun<Lanes>(triangles, block, resistance, flow, nodes);
  } else {
    addGathered<Lanes>(triangles, block, resistance, flow, nodes);
  }
}

// Sums in as many parts as there are lanes, so that the order of the additions is the same on every processor.
struct Sums {
  double force[3][kLanes] = {};
};

template <class Lanes>
WETCLOTH_INLINE void addTo(double* sums, const Lanes& lanes) {
  btScalar numbers[kLaneCount<Lanes>];
  store(numbers, lanes);
  for (std::size_t k = 0; k < kLaneCount<Lanes>; ++k) sums[k] += static_cast<double>(numbers[k]);
}

template <class Lanes>
WETCLOTH_INLINE void pushBlock(const TriangleDrag::Nodes& forces, PackedNodes& nodes, const TriangleDrag::Step& step,
                               std::size_t first, Sums& sums) {
  const btScalar* const inverseMass = nodes.inverseMass.data() + first;
  const Lanes one = everywhere<Lanes>(1);
  const Lanes zero = everywhere<Lanes>(0);
  for (std::size_t i = 0; i < kSize; i += kLaneCount<Lanes>) {
    const Lanes mass = load<Lanes>(inverseMass + i);
    const Lanes implicit =
        one / (one + everywhere<Lanes>(step.implicitDt) * load<Lanes>(forces.drag + first + i) * mass);
    const Lanes x = load<Lanes>(forces.force[0] + first + i) * implicit;
    const Lanes y = load<Lanes>(forces.force[1] + first + i) * implicit;
    const Lanes z = load<Lanes>(forces.force[2] + first + i) * implicit;
    const Lanes size = x + y + z;
    const auto isFinite = size - size == zero;
    const Lanes force[3] = {choose(isFinite, x, zero), choose(isFinite, y, zero), choose(isFinite, z, zero)};
    for (int axis = 0; axis < 3; ++axis) {
      btScalar* const velocity = nodes.velocity[axis].data() + first + i;
      store(velocity, load<Lanes>(velocity) + force[axis] * (everywhere<Lanes>(step.dt) * mass));
      addTo(sums.force[axis] + i % kLanes, force[axis]);
    }
  }
}

template <class Lanes>
WETCLOTH_INLINE btVector3 pushAll(const TriangleDrag::Nodes& forces, PackedNodes& nodes,
                                  const TriangleDrag::Step& step) {
  Sums sums;
  for (std::size_t first = 0; first < nodes.size(); first += kSize) pushBlock<Lanes>(forces, nodes, step, first, sums);
  btVector3 total(0, 0, 0);
  for (int axis = 0; axis < 3; ++axis) {
    double sum = 0;
    for (const double part : sums.force[axis]) sum += part;
    total[axis] = static_cast<btScalar>(sum);
  }
  return total;
}

#ifdef WETCLOTH_HAS_AVX2
WETCLOTH_AVX2 btVector3 pushWithAvx2(const TriangleDrag::Nodes& forces, PackedNodes& nodes,
                                     const TriangleDrag::Step& step) {
  return pushAll<WideLanes>(forces, nodes, step);
}

WETCLOTH_AVX2 void addWithAvx2(const TriangleBlocks& triangles, const Block& block, const FluidResistance& resistance,
                               const TriangleDrag::Flow* flow, const TriangleDrag::Nodes& nodes) {
  addBlock<WideLanes>(triangles, block, resistance, flow, nodes);
}
#endif

}  // namespace

void TriangleDrag::add(const TriangleBlocks& triangles, const Block& block, const FluidResistance& resistance,
                       const Flow* flow, const Nodes& nodes) {
#ifdef WETCLOTH_HAS_AVX2
  if (instructionSet() == InstructionSet::avx2) return addWithAvx2(triangles, block, resistance, flow, nodes);
#endif
  addBlock<NarrowLanes>(triangles, block, resistance, flow, nodes);
}

btVector3 TriangleDrag::push(const Nodes& forces, PackedNodes& nodes, const Step& step) {
#ifdef WETCLOTH_HAS_AVX2
  if (instructionSet() == InstructionSet::avx2) return pushWithAvx2(forces, nodes, step);
#endif
  return pushAll<NarrowLanes>(forces, nodes, step);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
