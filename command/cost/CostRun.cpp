// SPDX-License-Identifier: Zlib
#include "command/cost/CostRun.h"

#include "command/cli/Errors.h"
#include "command/scene/SoundState.h"

#include <algorithm>
#include <cmath>

namespace command {
namespace {

/// Numbers that are not finite are the same as each other: no comparison tells them apart.
bool same(const btVector3& a, const btVector3& b) {
  for (int axis = 0; axis < 3; ++axis) {
    if (a[axis] != b[axis] && (std::isfinite(a[axis]) || std::isfinite(b[axis]))) return false;
  }
  return true;
}

bool sameState(const btSoftBody& a, const btSoftBody& b) {
  for (int i = 0; i < a.m_nodes.size(); ++i) {
    if (!same(a.m_nodes[i].m_x, b.m_nodes[i].m_x) || !same(a.m_nodes[i].m_v, b.m_nodes[i].m_v)) return false;
  }
  return true;
}

}  // namespace

CostRun::CostRun(const Scene& scene) : m_scene(scene) {
  m_lanes.push_back({CostWorld::plain(scene), {}});
  m_lanes.push_back({CostWorld::idle(scene), {}});
  {
    const SceneWorld world(scene);
    m_effects = effectNames(world);
  }
  m_lanes.push_back({CostWorld::timed(scene), {}});
  m_lanes.push_back({CostWorld::timed(scene), {}});
  for (const std::string& effect : m_effects) m_lanes.push_back({CostWorld::timed(scene, effect), {}});
  // All first steps pay for what is set up once.
  for (Lane& lane : m_lanes) stepLane(lane, 0);
}  // NOLINT(clang-analyzer-cplusplus.NewDeleteLeaks): it loses sight of what the lanes' unique_ptr own

// No world always follows the same other one: it would always find the caches as that one leaves them.
void CostRun::turn(int most) {
  const int measured = std::min(most, measuredPerTurn());
  const std::size_t count = m_lanes.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t place = m_turns % 2 == 0 ? i : count - 1 - i;
    stepLane(m_lanes[(place + m_turns / 2) % count], measured);
  }
  ++m_turns;
  m_steps += measured;
  noticeBlowUp(measured);
}

int CostRun::measuredPerTurn() const {
  int most = 3;
  for (const ClothScene& cloth : m_scene.cloths) most = std::max(most, cloth.pace.substepsOf(m_scene.step));
  return most;
}

void CostRun::stepLane(Lane& lane, int measured) {
  for (int i = 0; i < unmeasured; ++i) lane.world.step();
  CostWorld::Seconds sum = {};
  for (int i = 0; i < measured; ++i) {
    const CostWorld::Seconds seconds = lane.world.step();
    sum.step += seconds.step;
    sum.ours += seconds.ours;
  }
  if (measured == 0) return;
  lane.samples.step.push_back(sum.step / measured);
  lane.samples.ours.push_back(sum.ours / measured);
}

/// What has blown up takes another time to compute: the turn that brought it does not count. Without its springs, say,
/// a cloth may not last as long as the scene does, and what was measured before stands.
void CostRun::noticeBlowUp(int measured) {
  for (std::size_t i = 0; i < m_lanes.size(); ++i) {
    const auto blowUp = describeBlowUp(m_lanes[i].world.world());
    if (!blowUp) continue;
    const std::string what = labelOf(i) + " " + *blowUp;
    const bool isTheScene = i == 2 || i == 3;
    if (isTheScene || steps() <= measured) throw RunError(m_scene.file + ": " + what);
    if (m_obstacle.empty()) m_obstacle = what;
  }
  if (m_obstacle.empty()) return;
  m_steps -= measured;
  for (Lane& lane : m_lanes) {
    lane.samples.step.pop_back();
    lane.samples.ours.pop_back();
  }
}

std::string CostRun::labelOf(std::size_t lane) const {
  if (lane == 0) return "in plain Bullet";
  if (lane == 1) return "without effects";
  return lane < 4 ? "with all effects" : "without " + m_effects[lane - 4];
}

int CostRun::nodes() const {
  int nodes = 0;
  for (const btSoftBody* body : m_lanes[0].world.world().bodies()) nodes += body->m_nodes.size();
  return nodes;
}

bool CostRun::isIdleSameAsPlain() const {
  const std::vector<btSoftBody*>& plain = m_lanes[0].world.world().bodies();
  const std::vector<btSoftBody*>& idle = m_lanes[1].world.world().bodies();
  return std::equal(plain.begin(), plain.end(), idle.begin(),
                    [](const btSoftBody* a, const btSoftBody* b) { return sameState(*a, *b); });
}

}  // namespace command
