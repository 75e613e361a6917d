// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/HullPlanes.h"

#include "bullet_wetcloth/numerics/BestLanes.h"
#include "bullet_wetcloth/numerics/Quad.h"

#include <algorithm>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

void HullPlanes::add(const std::array<double, 3>& normal, double offset) {
  const std::size_t first = m_count % kLanes;
  if (first == 0) m_blocks.emplace_back();
  ++m_count;
  Block& block = m_blocks.back();
  for (std::size_t lane = first; lane < kLanes; ++lane) {
    for (std::size_t k = 0; k < 3; ++k) block.normal[k][lane] = static_cast<btScalar>(normal[k]);
    block.offset[lane] = static_cast<btScalar>(offset);
  }
}

// Of each lane the block whose plane a point is farthest outside of, and how far [m].
struct HullPlanes::Farthest {
  const std::vector<Block>& blocks;
  const btVector3& point;
  btScalar enough;
  btScalar (&most)[kLanes];
  btScalar (&where)[kLanes];

  template <class Lanes>
  WETCLOTH_INLINE void run() const {
    constexpr std::size_t kLoads = kLanes / kLaneCount<Lanes>;
    const Lanes x = everywhere<Lanes>(point.x());
    const Lanes y = everywhere<Lanes>(point.y());
    const Lanes z = everywhere<Lanes>(point.z());
    Lanes farthest[kLoads];
    Lanes at[kLoads];
    for (std::size_t part = 0; part < kLoads; ++part) {
      farthest[part] = everywhere<Lanes>(-BT_LARGE_FLOAT);
      at[part] = everywhere<Lanes>(0);
    }
    unsigned areEnough = 0;
    for (std::size_t b = 0; b < blocks.size() && areEnough == 0; ++b) {
      const Block& block = blocks[b];
      for (std::size_t part = 0; part < kLoads; ++part) {
        const std::size_t lane = part * kLaneCount<Lanes>;
        const Lanes distance = load<Lanes>(block.normal[0] + lane) * x + load<Lanes>(block.normal[1] + lane) * y +
                               load<Lanes>(block.normal[2] + lane) * z - load<Lanes>(block.offset + lane);
        at[part] = choose(distance > farthest[part], everywhere<Lanes>(static_cast<btScalar>(b)), at[part]);
        farthest[part] = choose(distance > farthest[part], distance, farthest[part]);
        areEnough |= bitsOfLanes<Lanes>(farthest[part] > everywhere<Lanes>(enough));
      }
    }
    for (std::size_t part = 0; part < kLoads; ++part) {
      store(most + part * kLaneCount<Lanes>, farthest[part]);
      store(where + part * kLaneCount<Lanes>, at[part]);
    }
  }
};

ShapeDistance HullPlanes::distanceTo(const btVector3& point, btScalar enough, std::size_t& likely) const {
  const btScalar before = normalOf(likely).dot(point) - m_blocks[likely / kLanes].offset[likely % kLanes];
  if (before > enough) return {before, normalOf(likely)};
  btScalar most[kLanes];
  btScalar where[kLanes];
  runOnBestLanes(Farthest{m_blocks, point, enough, most, where});
  const std::size_t best = static_cast<std::size_t>(std::max_element(most, most + kLanes) - most);
  likely = static_cast<std::size_t>(where[best]) * kLanes + best;
  return {most[best], normalOf(likely)};
}

btVector3 HullPlanes::normalOf(std::size_t plane) const {
  const auto& normal = m_blocks[plane / kLanes].normal;
  const std::size_t lane = plane % kLanes;
  return btVector3(normal[0][lane], normal[1][lane], normal[2][lane]);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
