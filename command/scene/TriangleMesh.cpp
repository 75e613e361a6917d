// SPDX-License-Identifier: Zlib
#include "command/scene/TriangleMesh.h"

namespace command {

std::vector<std::array<float, 2>> sheetOf(const std::vector<btVector3>& vertices) {
  btVector3 low = vertices.front();
  btVector3 high = low;
  for (const btVector3& vertex : vertices) {
    low.setMin(vertex);
    high.setMax(vertex);
  }
  const int thin = (high - low).minAxis();
  std::vector<std::array<float, 2>> places;
  for (const btVector3& vertex : vertices) {
    places.push_back({static_cast<float>(vertex[(thin + 1) % 3]), static_cast<float>(vertex[(thin + 2) % 3])});
  }
  return places;
}

}  // namespace command
