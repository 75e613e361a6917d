// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/Scene.h"

#include <vector>

namespace command {

/// Moves the pinned nodes of a body, all by the same offset.
class Motion {
 public:
  Motion(btSoftBody& body, MotionScene scene);

  /// Puts the nodes where they are at this time [s].
  void moveTo(double time);

 private:
  btVector3 offsetAt(double time) const;

  btSoftBody& m_body;
  MotionScene m_scene;
  std::vector<int> m_nodes;
  std::vector<btVector3> m_starts;
};

}  // namespace command
