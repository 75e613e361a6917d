// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/NodeNormals.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/numerics/BestLanes.h"
#include "bullet_wetcloth/solver/Parts.h"
#include "bullet_wetcloth/solver/Prefetch.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

using Block = TriangleBlocks::Block;

}  // namespace

struct NodeNormals::Kernel {
  const TriangleBlocks& triangles;
  const MovingNodes& nodes;
  btScalar* normal[3];

  template <class Lanes>
  WETCLOTH_INLINE void run() const {
    for (const Block& block : triangles.blocks()) {
      block.isRun ? addRun<Lanes>(block) : addGathered(block);
    }
    for (std::size_t i = 0; i < nodes.count; i += kLaneCount<Lanes>) normalize<Lanes>(i);
  }

  template <class Lanes>
  WETCLOTH_INLINE void addRun(const Block& block) const {
    const btScalar* const isTaken = triangles.isTaken(block);
    const std::size_t a = toSize(block.first[0]);
    const std::size_t b = toSize(block.first[1]);
    const std::size_t c = toSize(block.first[2]);
    for (std::size_t k = 0; k < block.lanes; k += kLaneCount<Lanes>) {
      Lanes ab[3];
      Lanes ac[3];
      for (int axis = 0; axis < 3; ++axis) {
        const Lanes at = load<Lanes>(nodes.position[axis] + a + k);
        ab[axis] = load<Lanes>(nodes.position[axis] + b + k) - at;
        ac[axis] = load<Lanes>(nodes.position[axis] + c + k) - at;
      }
      const Lanes zero = everywhere<Lanes>(0);
      const auto isThere = load<Lanes>(isTaken + k) > zero;
      const Lanes n[3] = {choose(isThere, ab[1] * ac[2] - ab[2] * ac[1], zero),
                          choose(isThere, ab[2] * ac[0] - ab[0] * ac[2], zero),
                          choose(isThere, ab[0] * ac[1] - ab[1] * ac[0], zero)};
      for (int axis = 0; axis < 3; ++axis) {
        for (const std::size_t corner : {a, b, c}) {
          btScalar* const sum = normal[axis] + corner + k;
          store(sum, load<Lanes>(sum) + n[axis]);
        }
      }
    }
  }

  WETCLOTH_INLINE void addGathered(const Block& block) const {
    for (std::size_t k = 0; k < block.lanes && triangles.isTaken(block)[k] > 0; ++k) {
      const TriangleBlocks::Triangle corners = triangles.corners(block, k);
      const btVector3 a = nodes.placeOf(toSize(corners[0]));
      const btVector3 n = (nodes.placeOf(toSize(corners[1])) - a).cross(nodes.placeOf(toSize(corners[2])) - a);
      for (int axis = 0; axis < 3; ++axis) {
        for (const int corner : corners) normal[axis][corner] += n[axis];
      }
    }
  }

  template <class Lanes>
  WETCLOTH_INLINE void normalize(std::size_t i) const {
    const Lanes x = load<Lanes>(normal[0] + i);
    const Lanes y = load<Lanes>(normal[1] + i);
    const Lanes z = load<Lanes>(normal[2] + i);
    const Lanes length = squareRoot(x * x + y * y + z * z);
    const Lanes one = everywhere<Lanes>(1);
    const Lanes scale = one / choose(length > everywhere<Lanes>(SIMD_EPSILON), length, one);
    store(normal[0] + i, x * scale);
    store(normal[1] + i, y * scale);
    store(normal[2] + i, z * scale);
  }
};

void NodeNormals::reset(const btSoftBody& body, const NodeSlots& slots) {
  m_faces.resize(toSize(body.m_faces.size()));
  for (std::size_t k = 0; k < m_faces.size(); ++k) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const int node = nodeIndex(body, body.m_faces[static_cast<int>(k)].m_n[corner]);
      m_faces[k][corner] = slots.ofNode[toSize(node)];
    }
  }
  std::vector<TriangleBlocks::Triangle> different = m_faces;
  std::sort(different.begin(), different.end());
  different.erase(std::unique(different.begin(), different.end()), different.end());
  m_triangles.reset(std::move(different));
  for (Lane& axis : m_normal) axis.assign(slots.count + LocalNodes::kPadding, 0);
}

void NodeNormals::compute(const MovingNodes& nodes) {
  for (Lane& axis : m_normal) std::fill(axis.begin(), axis.end(), btScalar(0));
  runOnBestLanes(Kernel{m_triangles, nodes, {m_normal[0].data(), m_normal[1].data(), m_normal[2].data()}});
}

void NodeNormals::writeFaces(btSoftBody& body, const MovingNodes& nodes) const {
  forEachStretch(m_faces.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const TriangleBlocks::Triangle& corners = m_faces[k];
      const btVector3 a = nodes.placeOf(toSize(corners[0]));
      btVector3& normal = body.m_faces[static_cast<int>(k)].m_normal;
      prefetch(reinterpret_cast<const char*>(&normal) +
                   kPrefetchedAhead * static_cast<std::ptrdiff_t>(sizeof(btSoftBody::Face)),
               sizeof normal);
      normal = (nodes.placeOf(toSize(corners[1])) - a).cross(nodes.placeOf(toSize(corners[2])) - a);
      normal.safeNormalize();
    }
  });
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
