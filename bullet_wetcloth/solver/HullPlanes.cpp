// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/HullPlanes.h"

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

ShapeDistance HullPlanes::distanceTo(const btVector3& point) const {
  const btScalar x = point.x(), y = point.y(), z = point.z();
  btScalar most[kLanes];
  int where[kLanes];
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    most[lane] = -BT_LARGE_FLOAT;
    where[lane] = 0;
  }
  for (std::size_t b = 0; b < m_blocks.size(); ++b) {
    const Block& block = m_blocks[b];
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const btScalar distance =
          block.normal[0][lane] * x + block.normal[1][lane] * y + block.normal[2][lane] * z - block.offset[lane];
      const bool isFarther = distance > most[lane];
      most[lane] = isFarther ? distance : most[lane];
      where[lane] = isFarther ? static_cast<int>(b) : where[lane];
    }
  }
  std::size_t best = 0;
  for (std::size_t lane = 1; lane < kLanes; ++lane) {
    if (most[lane] > most[best]) best = lane;
  }
  const Block& block = m_blocks[static_cast<std::size_t>(where[best])];
  return {most[best], btVector3(block.normal[0][best], block.normal[1][best], block.normal[2][best])};
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
