// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/numerics/TriangleDrag.h"

#include "bullet_wetcloth/numerics/InstructionSet.h"

#include <cmath>
#include <cstddef>
#include <limits>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

using Block = TriangleBlocks::Block;
constexpr std::size_t kSize = TriangleBlocks::kSize;
constexpr std::size_t kLanes = TriangleBlocks::kLanes;

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

// Plain loops of a fixed shape, which compilers turn into vector code.
WETCLOTH_INLINE void push(const Corner (&corners)[3], const btScalar* isTaken, const TriangleDrag::Flow& flow,
                          const FluidResistance& resistance, std::size_t lanes, Pushes& out) {
  constexpr btScalar third = btScalar(1) / 3;
  const btScalar linear = resistance.linear / 6;
  const btScalar quadratic = resistance.quadratic / 3;
  const btScalar damping = 4 * resistance.dt * resistance.quadratic;
  const auto& [a, b, c] = corners;
  for (std::size_t f = 0; f < lanes; ++f) {
    const btScalar abx = b.position[0][f] - a.position[0][f], acx = c.position[0][f] - a.position[0][f];
    const btScalar aby = b.position[1][f] - a.position[1][f], acy = c.position[1][f] - a.position[1][f];
    const btScalar abz = b.position[2][f] - a.position[2][f], acz = c.position[2][f] - a.position[2][f];
    const btScalar nx = aby * acz - abz * acy;
    const btScalar ny = abz * acx - abx * acz;
    const btScalar nz = abx * acy - aby * acx;
    const btScalar squared = nx * nx + ny * ny + nz * nz;
    const auto towards = [&](const Corner& k) {
      return nx * (k.relative[0][f] + flow[0][f]) + ny * (k.relative[1][f] + flow[1][f]) +
             nz * (k.relative[2][f] + flow[2][f]);
    };
    const btScalar at[3] = {towards(a), towards(b), towards(c)};
    // A triangle without area feels nothing.
    const bool isFlat = (isTaken[f] > 0) & (squared >= std::numeric_limits<btScalar>::min()) &
                        (squared <= std::numeric_limits<btScalar>::max());
    // R / (6 |N|) with dampedSpeed() for the speed u = |N . (sum of relative velocities)| / (3 |N|), so arranged that one
    // division does.
    const btScalar along = std::fabs(at[0] + at[1] + at[2]) * third;
    const btScalar specificArea = (a.specificArea[f] + b.specificArea[f] + c.specificArea[f]) * third;
    const btScalar length = std::sqrt(squared);
    const btScalar root = std::sqrt(squared + damping * specificArea * along * length);
    const btScalar both = length + root;
    const btScalar share = (linear * both + quadratic * along) / (isFlat ? length * both : btScalar(1));
    out.normal[0][f] = isFlat ? nx : 0;
    out.normal[1][f] = isFlat ? ny : 0;
    out.normal[2][f] = isFlat ? nz : 0;
    for (std::size_t k = 0; k < 3; ++k) out.towards[k][f] = isFlat ? at[k] * share : 0;
    out.drag[f] = isFlat ? share * squared : 0;
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
WETCLOTH_INLINE void addToStretch(const Pushes& pushes, int corner, int first, std::size_t lanes,
                                  const TriangleDrag::Nodes& nodes) {
  const btScalar* const towards = pushes.towards[corner];
  for (int axis = 0; axis < 3; ++axis) {
    btScalar* const force = nodes.force[axis] + first;
    const btScalar* const normal = pushes.normal[axis];
    for (std::size_t f = 0; f < lanes; ++f) force[f] += normal[f] * towards[f];
  }
  btScalar* const drag = nodes.drag + first;
  for (std::size_t f = 0; f < lanes; ++f) drag[f] += pushes.drag[f];
}

WETCLOTH_INLINE void addRun(const TriangleBlocks& triangles, const Block& block, const FluidResistance& resistance,
                            const TriangleDrag::Flow& flow, const TriangleDrag::Nodes& nodes) {
  Pushes pushes;
  const std::size_t lanes = block.lanes / kLanes * kLanes;
  const Corner corners[3] = {stretch(nodes, block.first[0]), stretch(nodes, block.first[1]),
                             stretch(nodes, block.first[2])};
  push(corners, triangles.isTaken(block), flow, resistance, lanes, pushes);
  for (int k = 0; k < 3; ++k) addToStretch(pushes, k, block.first[static_cast<std::size_t>(k)], lanes, nodes);
}

struct Gathered {
  btScalar position[3][kSize];
  btScalar relative[3][kSize];
  btScalar specificArea[kSize];
};

WETCLOTH_INLINE void addGathered(const TriangleBlocks& triangles, const Block& block, const FluidResistance& resistance,
                                 const TriangleDrag::Flow& flow, const TriangleDrag::Nodes& nodes) {
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
  push(at, triangles.isTaken(block), flow, resistance, lanes, pushes);
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

WETCLOTH_INLINE void addBlock(const TriangleBlocks& triangles, const Block& block, const FluidResistance& resistance,
                              const TriangleDrag::Flow& flow, const TriangleDrag::Nodes& nodes) {
  if (block.isRun) {
    addRun(triangles, block, resistance, flow, nodes);
  } else {
    addGathered(triangles, block, resistance, flow, nodes);
  }
}

// Sums in as many parts as there are lanes, so that the order of the additions is the same on every processor.
struct Sums {
  double force[3][kSize] = {};
};

WETCLOTH_INLINE void pushBlock(const TriangleDrag::Nodes& forces, PackedNodes& nodes, const TriangleDrag::Step& step,
                               std::size_t first, Sums& sums) {
  const btScalar* const inverseMass = nodes.inverseMass.data() + first;
  const btScalar* const drag = forces.drag + first;
  btScalar force[3][kSize];
  btScalar gain[kSize];  // velocity per force, 0 where that is not finite
  for (std::size_t i = 0; i < kSize; ++i) {
    const btScalar implicit = 1 / (1 + step.implicitDt * drag[i] * inverseMass[i]);
    const btScalar x = forces.force[0][first + i] * implicit;
    const btScalar y = forces.force[1][first + i] * implicit;
    const btScalar z = forces.force[2][first + i] * implicit;
    const btScalar size = x + y + z;
    const bool isFinite = size - size == 0;
    force[0][i] = isFinite ? x : 0;
    force[1][i] = isFinite ? y : 0;
    force[2][i] = isFinite ? z : 0;
    gain[i] = step.dt * inverseMass[i];
  }
  for (int axis = 0; axis < 3; ++axis) {
    btScalar* const velocity = nodes.velocity[axis].data() + first;
    for (std::size_t i = 0; i < kSize; ++i) velocity[i] += force[axis][i] * gain[i];
    for (std::size_t i = 0; i < kSize; ++i) sums.force[axis][i] += static_cast<double>(force[axis][i]);
  }
}

WETCLOTH_INLINE btVector3 pushAll(const TriangleDrag::Nodes& forces, PackedNodes& nodes,
                                  const TriangleDrag::Step& step) {
  Sums sums;
  for (std::size_t first = 0; first < nodes.size(); first += kSize) pushBlock(forces, nodes, step, first, sums);
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
  return pushAll(forces, nodes, step);
}

WETCLOTH_AVX2 void addWithAvx2(const TriangleBlocks& triangles, const Block& block, const FluidResistance& resistance,
                               const TriangleDrag::Flow& flow, const TriangleDrag::Nodes& nodes) {
  addBlock(triangles, block, resistance, flow, nodes);
}
#endif

}  // namespace

void TriangleDrag::add(const TriangleBlocks& triangles, const Block& block, const FluidResistance& resistance,
                       const Flow& flow, const Nodes& nodes) {
#ifdef WETCLOTH_HAS_AVX2
  if (instructionSet() == InstructionSet::avx2) return addWithAvx2(triangles, block, resistance, flow, nodes);
#endif
  addBlock(triangles, block, resistance, flow, nodes);
}

btVector3 TriangleDrag::push(const Nodes& forces, PackedNodes& nodes, const Step& step) {
#ifdef WETCLOTH_HAS_AVX2
  if (instructionSet() == InstructionSet::avx2) return pushWithAvx2(forces, nodes, step);
#endif
  return pushAll(forces, nodes, step);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
