// SPDX-License-Identifier: Zlib
#include "command/stability/SceneMeter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace stability {
namespace {

// Rounding, and what Bullet's iterative solvers leave: as a speed where nothing moves at all [m/s].
constexpr double kSmallSpeed = 1e-3;
constexpr double kLedger = 1e-12;
constexpr double kOverfull = 1e-12;
constexpr double kFinalStretch = 0.1;
constexpr double kRestShare = 0.01;
constexpr double kBlownUp = 1e4;
constexpr double kShortLink = 0.1;  // of the mean rest length: shorter links are measured against this

}  // namespace

double SceneMeter::topSpeed() const {
  const Limits& limits = m_scene.limits;
  const double g = m_scene.gravity();
  return limits.source + std::sqrt(2 * g * limits.drop) + g * m_scene.dt() + kSmallSpeed;
}

bool SceneMeter::observeMotion(const CaseScene::Cloth& cloth) {
  double fastest = 0;
  for (int i = 0; i < cloth.body->m_nodes.size(); ++i) {
    const btSoftBody::Node& node = cloth.body->m_nodes[i];
    const double squared = double(node.m_v.length2());
    if (!std::isfinite(squared) || !std::isfinite(double(node.m_x.length2()))) return false;
    if (!(node.m_im > 0)) continue;
    fastest = std::max(fastest, squared);
    const double mass = 1 / double(node.m_im);
    m_kineticEnergy += mass * squared / 2;
    m_mass += mass;
  }
  m_meter.compare("speed", std::sqrt(fastest), m_scene.limits.whip * topSpeed());
  return true;
}

void SceneMeter::observeLinks(const CaseScene::Cloth& cloth, const char* bound, double share, double travel) {
  const double sag = cloth.stiffness > 0 && isDeformable(m_scene.world()) ? m_scene.limits.force / cloth.stiffness : 0;
  double worst = 0;
  const std::size_t count = std::min(cloth.restLengths.size(), static_cast<std::size_t>(cloth.body->m_links.size()));
  for (std::size_t k = 0; k < count; ++k) {
    const btSoftBody::Link& link = cloth.body->m_links[static_cast<int>(k)];
    const double rest = cloth.restLengths[k];
    const double length = double((link.m_n[0]->m_x - link.m_n[1]->m_x).length());
    const double allowed = share * std::max(rest, kShortLink * cloth.meanRestLength) + travel + sag;
    worst = std::max(worst, (length - rest) / allowed);
  }
  m_meter.compare(bound, worst, 1);
}

void SceneMeter::observeWater(const CaseScene::Cloth& cloth) {
  if (cloth.wet == nullptr) return;
  double fullest = 0;
  double held = 0;
  for (int i = 0; i < cloth.wet->nodeCount(); ++i) {
    const double saturation = cloth.wet->saturation(i);
    if (!(saturation >= 0)) fullest = HUGE_VAL;
    fullest = std::max(fullest, saturation);
    held += cloth.wet->held(i);
  }
  const wetcloth::Ledger ledger = cloth.wet->ledger();
  const double turnover = std::fabs(ledger.initial) + ledger.absorbed + ledger.dripped + ledger.evaporated;
  m_meter.compare("ledger", std::fabs(ledger.imbalance()), kLedger * turnover);
  m_meter.compare("ledger", std::fabs(ledger.held - held), kLedger * turnover);
  m_meter.compare("saturation", std::max(0.0, fullest - 1), kOverfull);
}

bool SceneMeter::observe() {
  m_kineticEnergy = m_mass = 0;
  for (const CaseScene::Cloth& cloth : m_scene.cloths()) {
    if (!observeMotion(cloth)) {
      m_meter.compare("finite", 1, 0);
      return false;
    }
    observeLinks(cloth, "stretch", m_scene.limits.stretch, 2 * topSpeed() * m_scene.dt());
    observeWater(cloth);
  }
  const double speed = topSpeed();
  const double allowed = m_mass * speed * speed / 2;
  m_meter.compare("energy", m_kineticEnergy, allowed);
  return m_kineticEnergy <= kBlownUp * allowed;
}

void SceneMeter::giveUp() {
  if (!std::isfinite(m_scene.limits.calmFrom)) return;
  m_meter.compare("rest", 1, 0);
  m_meter.compare("final stretch", 1, 0);
}

void SceneMeter::finish() {
  const Limits& limits = m_scene.limits;
  if (!(m_scene.time() > limits.calmFrom)) return;
  const double fall = m_scene.gravity() * limits.drop;
  const double putIn = fall > 0 ? fall : limits.source * limits.source / 2;
  m_meter.compare("rest", m_kineticEnergy, m_mass * (kRestShare * putIn + kSmallSpeed * kSmallSpeed));
  for (const CaseScene::Cloth& cloth : m_scene.cloths()) observeLinks(cloth, "final stretch", kFinalStretch, 0);
}

}  // namespace stability
