// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/water/Water.h"

#include <LinearMath/btTransform.h>

#include <cstddef>
#include <cstdint>
#include <vector>

class btCollisionObject;

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class StateArchive;

/// Films of water that landed on rigid bodies [kg], each where it landed: in cubic cells of a grid that moves with its
/// body. They stay where they are until something takes them.
///
/// Allocates when it is made, and when a body gets its first film.
class WETCLOTH_EXPORT BodyFilms {
 public:
  /// @param cellSize  of the grid [m], > 0
  /// @param mostPerCell  water that a cell keeps [kg], >= 0
  /// @param mostCells  that have water at a time, on all bodies together, >= 1
  BodyFilms(double cellSize, double mostPerCell, std::size_t mostCells);

  /// Adds water at a place on a body; returns what stays there: a cell that is full keeps no more [kg].
  double add(const btCollisionObject& body, const btVector3& place, double mass);
  /// Water at a place on a body: the cell's own to take from, or null where there is none.
  /// It is good until the next add(); give what was taken to took().
  double* find(const btCollisionObject& body, const btVector3& place);
  /// Water was taken from a cell that find() gave [kg].
  void took(double mass) {
    m_taken.add(mass);
    m_hasEmptied = true;
  }
  /// A body has left the world: its films go with it. Returns what that was [kg].
  double forget(const btCollisionObject& body);

  /// Whether no body has had a film yet.
  bool empty() const { return m_bodies.empty(); }
  /// Bodies that have had one; null in the place of one that was forgotten.
  const std::vector<const btCollisionObject*>& bodies() const { return m_bodies; }
  /// On all bodies [kg].
  double total() const;
  /// On one body [kg].
  double on(const btCollisionObject& body) const;
  /// What was ever taken from them [kg].
  double taken() const { return m_taken.value(); }

  /// Names what goes on from step to step: see StateArchive.
  void transferState(StateArchive& archive);

 private:
  struct Cell {
    int body = kNone;
    int at[3] = {0, 0, 0};
    double mass = 0;  // [kg]
  };
  static constexpr int kNone = -1;

  int bodyIndex(const btCollisionObject& body) const;
  bool locate(int body, const btVector3& local, Cell& wanted) const;
  // The cell's entry, or the free one where it belongs; m_cells.size() when there is neither.
  std::size_t slotOf(const Cell& wanted) const;
  void dropEmptied();
  void insertOnly(const std::vector<Cell>& cells);

  double m_cellSize;
  double m_mostPerCell;
  std::size_t m_mostCells;
  std::size_t m_used = 0;     // entries that have a body
  std::vector<Cell> m_cells;  // open addressing; twice as many as are used at most
  std::vector<Cell> m_kept;   // while dropEmptied() runs
  bool m_hasEmptied = false;
  std::vector<const btCollisionObject*> m_bodies;
  CompensatedSum m_taken;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
