// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/Scene.h"

#include <vector>

namespace command {

/// Turns the nodes of a patch's edge about the line through the middles of that edge and the opposite one, towards
/// which they move meanwhile, and lets them go when the scene says so.
class Twist {
 public:
  Twist(btSoftBody& body, const wetcloth::ClothPatch& patch, const TwistScene& scene);

  /// Puts the nodes where they are at this time [s].
  void moveTo(double time);

 private:
  void letGo();

  btSoftBody& m_body;
  TwistScene m_scene;
  std::vector<int> m_nodes;
  std::vector<btVector3> m_starts;
  std::vector<double> m_dryMasses;  // of these nodes [kg]
  bool m_isHeld = true;
  btVector3 m_centre;
  btVector3 m_axis;
  btVector3 m_inwards;  // from the edge to the opposite one
};

}  // namespace command
