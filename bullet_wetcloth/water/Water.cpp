// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/water/Water.h"

#include "bullet_wetcloth/IeeeArithmetic.h"
#include "bullet_wetcloth/state/StateArchive.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

double compensatedSum(const std::vector<double>& values) {
  CompensatedSum total;
  for (const double value : values) total.add(value);
  return total.value();
}

void CompensatedSum::transferState(StateArchive& archive) { archive.value(m_sum, m_compensation); }

Ledger Water::ledger() const {
  Ledger ledger;
  ledger.initial = m_initial.value();
  CompensatedSum absorbed = m_absorbed;
  for (const double part : m_newlyAbsorbed) absorbed.add(part);
  ledger.absorbed = absorbed.value();
  ledger.dripped = m_dripped.value();
  ledger.evaporated = m_evaporated.value();
  ledger.held = compensatedSum(m_held);
  ledger.runOff = m_runOff.value();
  return ledger;
}

double Water::moved() const {
  double absorbed = m_absorbed.value();
  for (const double part : m_newlyAbsorbed) absorbed += part;
  return absorbed + m_dripped.value() + m_evaporated.value() + m_movedWithin;
}

void Water::strike(std::size_t node, double mass, double vx, double vy, double vz) {
  Arrival& arrival = m_arrivals[node];
  arrival.runOff += mass;
  arrival.momentum[0] += mass * vx;
  arrival.momentum[1] += mass * vy;
  arrival.momentum[2] += mass * vz;
  m_runOff.add(mass);
  m_movedSinceCommit = true;  // no revision: the water is as it was
}

// What leaves is a sample of the node's water: its share of what arrived since the last commit goes on with the
// momentum that it brought. So a node can pass on more than it weighed.
void Water::move(std::size_t from, std::size_t to, double mass, double vx, double vy, double vz) {
  const double moved = std::min(mass, m_held[from]);
  if (!(moved > 0) || from == to) return;
  Arrival& source = m_arrivals[from];
  Arrival& target = m_arrivals[to];
  const double fresh = std::min(moved / m_held[from] * source.mass, moved);
  const double old = moved - fresh;
  const double velocity[3] = {vx, vy, vz};
  for (int axis = 0; axis < 3; ++axis) {
    const double passedOn = fresh > 0 ? source.momentum[axis] * (fresh / (source.mass + source.runOff)) : 0;
    source.momentum[axis] -= passedOn;
    target.momentum[axis] += passedOn + old * velocity[axis];
  }
  source.mass -= fresh;
  source.shifted -= old;
  target.mass += moved;
  m_held[from] -= moved;
  m_held[to] += moved;
  m_movedWithin += moved;
  m_leftSinceCommit = true;
  markMoved();
}

void Water::redistribute(const std::vector<double>& held) {
  CompensatedSum rounding;
  for (std::size_t i = 0; i < m_held.size(); ++i) {
    const double change = held[i] - m_held[i];
    rounding.add(change);
    m_held[i] = held[i];
    m_movedWithin += change > 0 ? change : 0;
    m_arrivals[i].shifted += change;
  }
  m_initial.add(rounding.value());
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

void Water::keepShed(bool keeps) {
  m_keepsShed = keeps;
  m_shed.resize(keeps ? m_held.size() : 0, 0);
}

void Water::joinArrival(std::size_t node) {
  const double shifted = m_arrivals[node].shifted + m_arrivals[node].mass;
  m_arrivals[node] = Arrival();
  m_arrivals[node].shifted = shifted;
}

void Water::clearArrivals() {
  std::fill(m_arrivals.begin(), m_arrivals.end(), Arrival());
  for (const double part : m_newlyAbsorbed) m_absorbed.add(part);
  m_newlyAbsorbed.fill(0);
  m_movedSinceCommit = m_leftSinceCommit = false;
}

void Water::reset(std::vector<double> dryMass, const std::vector<double>& capacityRatios,
                  std::vector<int> fabricOfNode) {
  m_dryMass = std::move(dryMass);
  m_fabric = std::move(fabricOfNode);
  m_parts.clear();
  for (const double ratio : capacityRatios) m_parts.push_back({ratio, 0});
  sumDryMasses();
  setCapacities();
  m_held.assign(m_dryMass.size(), 0);
  m_arrivals.assign(m_dryMass.size(), Arrival());
  m_initial = m_absorbed = m_dripped = m_evaporated = m_runOff = m_handedOver = CompensatedSum();
  m_newlyAbsorbed.fill(0);
  markMoved();
  m_movedSinceCommit = m_leftSinceCommit = false;
}

void Water::sumDryMasses() {
  std::vector<CompensatedSum> sums(m_parts.size());
  for (std::size_t i = 0; i < m_dryMass.size(); ++i) sums[fabric(i)].add(m_dryMass[i]);
  for (std::size_t k = 0; k < sums.size(); ++k) m_parts[k].dryMass = sums[k].value();
}

void Water::setCapacities() {
  m_capacity.resize(m_dryMass.size());
  for (std::size_t i = 0; i < m_capacity.size(); ++i) {
    m_capacity[i] = std::max(capacityRatio(fabric(i)) * m_dryMass[i], std::numeric_limits<double>::min());
  }
}

void Water::setHeld(const std::vector<double>& held) {
  for (std::size_t i = 0; i < held.size(); ++i) {
    m_initial.add(held[i]);
    m_initial.add(-m_held[i]);
    m_movedWithin += std::fabs(held[i] - m_held[i]);
    m_held[i] = held[i];
  }
  markMoved();
}

void Water::replaceNodes(std::vector<double> dryMass, std::vector<double> held, std::vector<int> fabricOfNode) {
  // Rounding of the redistribution is booked, so that the ledger stays closed for as long as the cloth lives.
  m_initial.add(compensatedSum(held));
  m_initial.add(-compensatedSum(m_held));
  m_dryMass = std::move(dryMass);
  m_fabric = std::move(fabricOfNode);
  sumDryMasses();
  setCapacities();
  m_held = std::move(held);
  m_arrivals.assign(m_held.size(), Arrival());
  keepShedOfGoneNodes();
  ++m_revision;
  // A dry cloth's masses are as the application left them.
  m_movedSinceCommit = m_movedSinceCommit || compensatedSum(m_held) > 0;
}

// It is some other node's to let go of.
void Water::keepShedOfGoneNodes() {
  if (!m_keepsShed) return;
  for (std::size_t i = m_held.size(); i < m_shed.size(); ++i) m_shed[0] += m_shed[i];
  m_shed.resize(m_held.size(), 0);
  m_hasShedMore = true;
}

void Water::transferState(StateArchive& archive) {
  archive.array(m_held);
  archive.array(m_dryMass);
  archive.each(m_arrivals, [&](Arrival& arrival) {
    archive.value(arrival.mass, arrival.momentum[0], arrival.momentum[1], arrival.momentum[2]);
    archive.value(arrival.runOff, arrival.shifted);
  });
  const std::size_t fabrics = m_parts.size();
  archive.each(m_fabric, [&](int& fabric) {
    const int found = archive.place(fabric, static_cast<int>(fabrics), "a node's fabric");
    if (archive.isRestoring()) fabric = found;
  });
  archive.each(m_parts, [&](Part& part) { archive.value(part.capacityRatio, part.dryMass); });
  if (archive.isRestoring()) setCapacities();
  archive.value(m_movedWithin);
  for (double& part : m_newlyAbsorbed) archive.value(part);
  for (auto* sum : {&m_initial, &m_absorbed, &m_dripped, &m_evaporated, &m_runOff, &m_handedOver})
    sum->transferState(archive);
  archive.expect(m_keepsShed, "whether what leaves a cloth is followed");
  archive.array(m_shed);
  archive.value(m_hasShedMore);
  archive.value(m_revision, m_movedSinceCommit, m_leftSinceCommit);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
