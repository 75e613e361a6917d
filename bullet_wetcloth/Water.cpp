#include "bullet_wetcloth/Water.h"

#include <algorithm>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

double sum(const std::vector<double>& values) {
  CompensatedSum total;
  for (const double value : values) total.add(value);
  return total.value();
}

}  // namespace

Ledger Water::ledger() const {
  Ledger ledger;
  ledger.initial = m_initial.value();
  CompensatedSum absorbed = m_absorbed;
  for (const double part : m_newlyAbsorbed) absorbed.add(part);
  ledger.absorbed = absorbed.value();
  ledger.dripped = m_dripped.value();
  ledger.evaporated = m_evaporated.value();
  ledger.held = sum(m_held);
  return ledger;
}

void Water::move(std::size_t from, std::size_t to, double mass, double vx, double vy, double vz) {
  const double moved = std::min(mass, m_held[from]);
  if (!(moved > 0) || from == to) return;
  m_held[from] -= moved;
  m_held[to] += moved;
  Arrival& arrival = m_arrivals[to];
  arrival.mass += moved;
  arrival.momentum[0] += moved * vx;
  arrival.momentum[1] += moved * vy;
  arrival.momentum[2] += moved * vz;
  m_leftSinceCommit = true;
  markMoved();
}

double Water::take(std::size_t node, double mass, CompensatedSum& account) {
  const double before = m_held[node];
  const double wanted = std::min(mass, before);
  if (!(wanted > 0)) return 0;
  m_held[node] = before - wanted;
  const double left = before - m_held[node];
  account.add(left);
  m_leftSinceCommit = true;
  markMoved();
  return left;
}

void Water::clearArrivals() {
  std::fill(m_arrivals.begin(), m_arrivals.end(), Arrival());
  for (const double part : m_newlyAbsorbed) m_absorbed.add(part);
  m_newlyAbsorbed.fill(0);
  m_movedSinceCommit = m_leftSinceCommit = false;
}

void Water::reset(std::vector<double> dryMass, double capacityRatio) {
  m_dryMass = std::move(dryMass);
  m_held.assign(m_dryMass.size(), 0);
  m_arrivals.assign(m_dryMass.size(), Arrival());
  m_capacityRatio = capacityRatio;
  m_initial = m_absorbed = m_dripped = m_evaporated = CompensatedSum();
  m_newlyAbsorbed.fill(0);
  markMoved();
  m_movedSinceCommit = m_leftSinceCommit = false;
}

void Water::setHeld(const std::vector<double>& held) {
  for (std::size_t i = 0; i < held.size(); ++i) {
    m_initial.add(held[i]);
    m_initial.add(-m_held[i]);
    m_held[i] = held[i];
  }
  markMoved();
}

void Water::replaceNodes(std::vector<double> dryMass, std::vector<double> held) {
  // Rounding of the redistribution is booked, so that the ledger stays closed for as long as the cloth lives.
  m_initial.add(sum(held));
  m_initial.add(-sum(m_held));
  m_dryMass = std::move(dryMass);
  m_held = std::move(held);
  m_arrivals.assign(m_held.size(), Arrival());
  markMoved();
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
