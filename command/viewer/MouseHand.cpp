// SPDX-License-Identifier: Zlib
#include "command/viewer/MouseHand.h"

#include <imgui.h>

#include <cmath>

namespace viewer {
namespace {

constexpr double radiansPerHeight = 3;  // of the camera, when the mouse crosses the window
constexpr double zoomPerNotch = 0.9;

Ray rayAt(const ImVec2& mouse, const OrbitCamera& camera, const ViewLayout& layout, Side side) {
  const auto [x, y] = layout.inPicture(static_cast<double>(mouse.x), static_cast<double>(mouse.y), side);
  return camera.rayThrough(x, y, layout.aspect());
}

}  // namespace

void MouseHand::take(LiveScene& live, OrbitCamera& camera, const ViewLayout& layout) {
  const ImGuiIO& io = ImGui::GetIO();
  if (m_task != Task::nothing && !ImGui::IsMouseDown(m_button)) {
    if (m_task == Task::drag) live.release();
    m_task = Task::nothing;
  }
  if (!io.WantCaptureMouse && io.MouseWheel != 0) {
    camera.zoom(std::pow(zoomPerNotch, static_cast<double>(io.MouseWheel)));
  }
  if (m_task == Task::nothing) {  // what the mouse did before the button went down is no drag
    if (!io.WantCaptureMouse) begin(live, camera, layout);
    return;
  }
  const double right = static_cast<double>(io.MouseDelta.x) / layout.height;
  const double down = static_cast<double>(io.MouseDelta.y) / layout.height;
  if (m_task == Task::orbit) camera.orbit(-radiansPerHeight * right, radiansPerHeight * down);
  if (m_task == Task::pan) camera.pan(-right, down);
  if (m_task == Task::drag) drag(live, camera, layout);
}

void MouseHand::begin(LiveScene& live, const OrbitCamera& camera, const ViewLayout& layout) {
  const bool isLeft = ImGui::IsMouseClicked(ImGuiMouseButton_Left);
  const bool isRight = ImGui::IsMouseClicked(ImGuiMouseButton_Right);
  if (!isLeft && !isRight && !ImGui::IsMouseClicked(ImGuiMouseButton_Middle)) return;
  m_button = isLeft ? ImGuiMouseButton_Left : isRight ? ImGuiMouseButton_Right : ImGuiMouseButton_Middle;
  m_side = layout.sideAt(static_cast<double>(ImGui::GetIO().MousePos.x));
  if (!isLeft || ImGui::GetIO().KeyShift) {
    m_task = Task::pan;
  } else {
    m_task = grab(live, camera, layout) ? Task::drag : Task::orbit;
  }
}

bool MouseHand::grab(LiveScene& live, const OrbitCamera& camera, const ViewLayout& layout) {
  if (!live.grab(rayAt(ImGui::GetIO().MousePos, camera, layout, m_side), m_side)) return false;
  ++m_drags;
  const btVector3 place = live.grip()->node().m_x;
  m_depth = camera.depthOf(place);
  m_offset = place - underMouse(camera, layout, m_depth);
  return true;
}

/// Across the view, at the depth at which the cloth was taken.
void MouseHand::drag(LiveScene& live, const OrbitCamera& camera, const ViewLayout& layout) {
  live.dragTo(underMouse(camera, layout, m_depth) + m_offset);
}

btVector3 MouseHand::underMouse(const OrbitCamera& camera, const ViewLayout& layout, btScalar depth) const {
  const Ray ray = rayAt(ImGui::GetIO().MousePos, camera, layout, m_side);
  return ray.origin + ray.direction * (depth / camera.depthOf(ray.origin + ray.direction));
}

}  // namespace viewer
