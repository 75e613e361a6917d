// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/water/BodyFilms.h"

#include "bullet_wetcloth/state/StateArchive.h"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

#include <algorithm>
#include <cmath>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

// Surfaces are often at round numbers, where a grid from the origin would have its planes.
constexpr double kShift = 0.381966;  // of a cell

std::size_t powerOfTwoAbove(std::size_t count) {
  std::size_t power = 1;
  while (power < count) power *= 2;
  return power;
}

}  // namespace

BodyFilms::BodyFilms(double cellSize, double mostPerCell, std::size_t mostCells)
    : m_cellSize(cellSize),
      m_mostPerCell(mostPerCell),
      m_mostCells(mostCells),
      m_cells(powerOfTwoAbove(2 * mostCells)) {
  m_kept.reserve(mostCells);
}

double BodyFilms::add(const btCollisionObject& body, const btVector3& place, double mass) {
  if (!(m_mostPerCell > 0)) return 0;
  int index = bodyIndex(body);
  Cell wanted;
  if (!locate(index, body.getWorldTransform().invXform(place), wanted)) return 0;
  if (index == kNone) {
    index = static_cast<int>(m_bodies.size());
    m_bodies.push_back(&body);
  }
  wanted.body = index;
  if (m_used == m_mostCells && m_hasEmptied) dropEmptied();
  Cell& cell = m_cells[slotOf(wanted)];
  if (cell.body == kNone) {
    if (m_used == m_mostCells) return 0;
    ++m_used;
    cell = wanted;
  }
  const double before = cell.mass;
  cell.mass = std::min(before + mass, std::max(before, m_mostPerCell));
  return cell.mass - before;
}

double* BodyFilms::find(const btCollisionObject& body, const btVector3& place) {
  const int index = bodyIndex(body);
  Cell wanted;
  if (index == kNone || !locate(index, body.getWorldTransform().invXform(place), wanted)) return nullptr;
  Cell& cell = m_cells[slotOf(wanted)];
  return cell.body != kNone && cell.mass > 0 ? &cell.mass : nullptr;
}

double BodyFilms::forget(const btCollisionObject& body) {
  const int index = bodyIndex(body);
  if (index == kNone) return 0;
  const double lost = on(body);
  for (Cell& cell : m_cells) {
    if (cell.body == index) cell.mass = 0;
  }
  m_bodies[static_cast<std::size_t>(index)] = nullptr;
  m_hasEmptied = true;
  return lost;
}

double BodyFilms::total() const {
  CompensatedSum sum;
  for (const Cell& cell : m_cells) sum.add(cell.mass);
  return sum.value();
}

double BodyFilms::on(const btCollisionObject& body) const {
  const int index = bodyIndex(body);
  CompensatedSum sum;
  for (const Cell& cell : m_cells) sum.add(index != kNone && cell.body == index ? cell.mass : 0);
  return sum.value();
}

int BodyFilms::bodyIndex(const btCollisionObject& body) const {
  for (std::size_t i = 0; i < m_bodies.size(); ++i) {
    if (m_bodies[i] == &body) return static_cast<int>(i);
  }
  return kNone;
}

bool BodyFilms::locate(int body, const btVector3& local, Cell& wanted) const {
  wanted.body = body;
  for (int axis = 0; axis < 3; ++axis) {
    const double cell = std::floor(static_cast<double>(local[axis]) / m_cellSize + kShift);
    if (!(std::fabs(cell) < 1e9)) return false;
    wanted.at[axis] = static_cast<int>(cell);
  }
  return true;
}

std::size_t BodyFilms::slotOf(const Cell& wanted) const {
  const auto mixed = [](std::uint64_t value) { return (value ^ (value >> 29)) * 0x9e3779b97f4a7c15u; };
  std::uint64_t hash = static_cast<std::uint64_t>(wanted.body);
  for (const int at : wanted.at) hash = mixed(hash + static_cast<std::uint64_t>(static_cast<std::uint32_t>(at)));
  const std::size_t mask = m_cells.size() - 1;
  std::size_t slot = static_cast<std::size_t>(hash >> 20) & mask;
  const auto isIt = [&](const Cell& cell) {
    return cell.body == wanted.body && std::equal(cell.at, cell.at + 3, wanted.at);
  };
  while (m_cells[slot].body != kNone && !isIt(m_cells[slot])) slot = (slot + 1) & mask;
  return slot;
}

void BodyFilms::dropEmptied() {
  m_kept.clear();
  for (const Cell& cell : m_cells) {
    if (cell.mass > 0) m_kept.push_back(cell);
  }
  insertOnly(m_kept);
  m_hasEmptied = false;
}

void BodyFilms::insertOnly(const std::vector<Cell>& cells) {
  std::fill(m_cells.begin(), m_cells.end(), Cell());
  m_used = std::min(cells.size(), m_mostCells);
  for (std::size_t i = 0; i < m_used; ++i) m_cells[slotOf(cells[i])] = cells[i];
}

void BodyFilms::transferState(StateArchive& archive) {
  archive.growing(m_bodies, [&](const btCollisionObject*& body) { archive.object(body); });
  std::vector<Cell> used;
  for (const Cell& cell : m_cells) {
    if (cell.body != kNone) used.push_back(cell);
  }
  archive.growing(used, [&](Cell& cell) {
    archive.local(cell.body);
    for (int& at : cell.at) archive.local(at);
    archive.local(cell.mass);
    if (archive.isChecking() && !(cell.body >= 0 && cell.mass >= 0)) archive.fail("a film is on no body");
  });
  m_taken.transferState(archive);
  archive.value(m_hasEmptied);
  if (archive.isRestoring()) insertOnly(used);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
