// SPDX-License-Identifier: Zlib
#include "command/plot/WickingStrip.h"

#include "command/scene/BlowUp.h"
#include "command/scene/SoundState.h"

namespace command {
namespace {

constexpr double stripSpeed = 1;  // all its nodes are pinned [m/s]

/// Nothing to solve: all nodes are pinned.
BulletWorld::Settings withoutLinks() {
  BulletWorld::Settings settings;
  settings.iterations = 0;
  return settings;
}

}  // namespace

WickingStrip::WickingStrip(const Settings& settings) : m_settings(settings), m_world(withoutLinks()) {
  m_world.worldInfo().water_normal = btVector3(0, 1, 0);
  m_world.worldInfo().water_offset = 0;
  m_world.worldInfo().water_density = 1000;
  m_patch.columns = 2;
  m_patch.rows = settings.rows;
  m_patch.origin = btVector3(btScalar(-0.01), btScalar(-settings.dipped), 0);
  m_patch.edgeU = btVector3(btScalar(0.02), 0, 0);
  m_patch.edgeV = btVector3(0, btScalar(settings.length), 0);
  m_patch.pinnedEdges = {wetcloth::ClothPatch::Edge::left, wetcloth::ClothPatch::Edge::right};
  m_body = &m_world.add(m_patch.build(m_world.worldInfo()));
  m_cloth = &m_world.wet().add(*m_body, settings.fabric);
  m_cloth->setPace(wetcloth::WaterPace::exact());
  m_cloth->add<wetcloth::Immersion>();
  m_cloth->add<wetcloth::Diffusion>(settings.diffusion);
  if (settings.feelsGravity) m_cloth->add<wetcloth::Seepage>(settings.seepage);
}

void WickingStrip::advance() {
  m_world.substep(btScalar(m_settings.step));
  ++m_steps;
  requireSound(findBlowUp(*m_body, {stripSpeed, m_settings.step}), time());
}

double WickingStrip::front() const {
  int row = 0;
  while (row + 1 < rows() && saturation(row + 1) >= frontLevel) ++row;
  if (row + 1 == rows()) return height(row);
  const double below = saturation(row);
  const double share = (below - frontLevel) / (below - saturation(row + 1));
  return height(row) + share * (height(row + 1) - height(row));
}

}  // namespace command
