// SPDX-License-Identifier: Zlib
#pragma once

#include "command/viewer/LiveScene.h"
#include "command/viewer/OrbitCamera.h"
#include "command/viewer/ViewLayout.h"

namespace viewer {

/// What the mouse does in the scene: on a cloth the left button takes hold of it, elsewhere it turns the camera; the
/// middle and right button, or the left one with shift, move the camera; the wheel zooms.
class MouseHand {
 public:
  /// Between Dear ImGui's beginning of a picture and its end.
  void take(LiveScene& live, OrbitCamera& camera, const ViewLayout& layout);
  /// How often a cloth was held.
  int drags() const { return m_drags; }

 private:
  enum class Task { nothing, drag, orbit, pan };

  void begin(LiveScene& live, const OrbitCamera& camera, const ViewLayout& layout);
  void drag(LiveScene& live, const OrbitCamera& camera, const ViewLayout& layout);
  bool grab(LiveScene& live, const OrbitCamera& camera, const ViewLayout& layout);
  btVector3 underMouse(const OrbitCamera& camera, const ViewLayout& layout, btScalar depth) const;

  Task m_task = Task::nothing;
  int m_button = 0;
  int m_drags = 0;
  Side m_side = Side::wet;
  btScalar m_depth = 0;                     // of the held node before the camera [m]
  btVector3 m_offset = btVector3(0, 0, 0);  // of the held node from what is under the mouse [m]
};

}  // namespace viewer
