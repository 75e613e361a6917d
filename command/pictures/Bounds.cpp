// SPDX-License-Identifier: Zlib
#include "command/pictures/Bounds.h"

#include "command/pictures/PosedSolid.h"
#include "command/pictures/VectorMath.h"

#include <algorithm>
#include <cstddef>

namespace pictures {

void Bounds::add(const Vector3& point) {
  for (std::size_t i = 0; i < 3; ++i) {
    low[i] = std::min(low[i], point[i]);
    high[i] = std::max(high[i], point[i]);
  }
}

Vector3 Bounds::middle() const { return (low + high) * 0.5F; }

float Bounds::diagonal() const { return length(high - low); }

Bounds boundsOf(const FrameSequence& sequence) {
  Bounds bounds;
  for (const Frame& frame : sequence.frames) {
    for (const ClothState& cloth : frame.cloths) {
      for (const Vector3& position : cloth.positions) bounds.add(position);
    }
    if (frame.poses.empty() && &frame != &sequence.frames.front()) continue;  // the solids are there already
    for (const Vector3& vertex : posedVertices(sequence.scenery, frame)) bounds.add(vertex);
  }
  return bounds;
}

}  // namespace pictures
