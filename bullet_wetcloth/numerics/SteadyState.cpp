// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/numerics/SteadyState.h"

#include "bullet_wetcloth/state/StateArchive.h"
#include "bullet_wetcloth/water/Water.h"

#include <algorithm>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr double kQuiet = 1e-9;  // of the capacity, moved in a second
constexpr int kPatience = 64;    // quiet steps before it settles
// More than kPatience quiet steps of another effect: two that settle must not keep each other awake.
constexpr double kDisturbed = 1e-7;
constexpr std::size_t kLooks = 32;           // steps in which each node is looked at once
constexpr btScalar kMoved = btScalar(1e-3);  // of the body's size

}  // namespace

void SteadyState::restart() {
  m_isReached = false;
  m_quietSteps = 0;
}

bool SteadyState::isReached(const btSoftBody& body, const Water& water, const btVector3& gravity) {
  if (!m_isReached) return false;
  const bool isDisturbed =
      water.moved() - m_movedBefore > kDisturbed * m_capacity || water.totalCapacity() != m_capacity;
  if (isDisturbed || (m_inputs == DependsOn::waterAndShape && shapeChanged(body, gravity))) restart();
  return m_isReached;
}

void SteadyState::note(const btSoftBody& body, const Water& water, const btVector3& gravity, double dt, double moved) {
  m_shape.resize(m_inputs == DependsOn::waterAndShape ? water.size() : 0, btVector3(0, 0, 0));
  const double capacity = water.totalCapacity();
  const bool isQuiet = moved <= kQuiet * capacity * std::min(dt, 1.0);
  m_quietSteps = isQuiet ? m_quietSteps + 1 : 0;
  if (m_quietSteps < kPatience) return;
  m_isReached = true;
  m_capacity = capacity;
  m_movedBefore = water.moved();
  if (m_inputs == DependsOn::waterAndShape) rememberShape(body, gravity);
}

bool SteadyState::shapeChanged(const btSoftBody& body, const btVector3& gravity) {
  if (!(gravity == m_gravity) || m_shape.size() != static_cast<std::size_t>(body.m_nodes.size())) return true;
  const std::size_t share = (m_shape.size() + kLooks - 1) / kLooks;
  for (std::size_t k = 0; k < share; ++k) {
    m_nextNode = m_nextNode + 1 < m_shape.size() ? m_nextNode + 1 : 0;
    const btVector3& now = body.m_nodes[static_cast<int>(m_nextNode)].m_x;
    if ((now - m_shape[m_nextNode]).length2() > m_tolerance2) return true;
  }
  return false;
}

void SteadyState::rememberShape(const btSoftBody& body, const btVector3& gravity) {
  for (std::size_t i = 0; i < m_shape.size(); ++i) m_shape[i] = body.m_nodes[static_cast<int>(i)].m_x;
  const btScalar tolerance = kMoved * (body.m_bounds[1] - body.m_bounds[0]).length();
  m_tolerance2 = tolerance * tolerance;
  m_gravity = gravity;
}

void SteadyState::transferState(StateArchive& archive) {
  archive.value(m_quietSteps, m_isReached, m_capacity, m_movedBefore, m_gravity, m_tolerance2);
  archive.growingArray(m_shape);
  archive.value(m_nextNode);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
