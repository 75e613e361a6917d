// SPDX-License-Identifier: Zlib
#include "command/scene/Motion.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace command {

Motion::Motion(btSoftBody& body, MotionScene scene) : m_body(body), m_scene(std::move(scene)) {
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    if (body.m_nodes[i].m_im > 0) continue;
    m_nodes.push_back(i);
    m_starts.push_back(body.m_nodes[i].m_x);
  }
}

void Motion::moveTo(double time) {
  const btVector3 offset = offsetAt(time);
  for (std::size_t i = 0; i < m_nodes.size(); ++i) m_body.m_nodes[m_nodes[i]].m_x = m_starts[i] + offset;
}

btVector3 Motion::offsetAt(double time) const {
  const std::vector<double>& times = m_scene.times;
  const auto next = static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), time) - times.begin());
  if (next == 0) return m_scene.offsets.front();
  if (next == times.size()) return m_scene.offsets.back();
  const double share = (time - times[next - 1]) / (times[next] - times[next - 1]);
  return m_scene.offsets[next - 1] + (m_scene.offsets[next] - m_scene.offsets[next - 1]) * btScalar(share);
}

}  // namespace command
