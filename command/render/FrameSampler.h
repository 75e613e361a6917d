// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/SceneWorld.h"

#include "command/pictures/FrameSequence.h"

#include <vector>

namespace command {

/// Tells what pictures need to know of a world that runs, in the plain numbers of pictures::FrameSequence.
class FrameSampler {
 public:
  /// @param world before its first step: its links are at rest
  explicit FrameSampler(const SceneWorld& world);

  const pictures::Scenery& scenery() const { return m_scenery; }
  const std::vector<pictures::ClothShape>& cloths() const { return m_cloths; }

  /// The world as it is now, and the drops that are falling from its cloths. Reuses the memory of `frame`.
  /// @param world the same one, or another of the same scene
  void take(const SceneWorld& world, double time, pictures::Frame& frame) const;

 private:
  pictures::Scenery m_scenery;
  std::vector<pictures::ClothShape> m_cloths;
  std::vector<double> m_solidAreas;               // of the scenery's solids [m^2]
  std::vector<std::vector<float>> m_restLengths;  // of each cloth's links [m]
};

}  // namespace command
