// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <LinearMath/btVector3.h>

#include <array>
#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Which triangles of a cloth are behind others of it along a stream: those whose centroid is downstream of another
/// triangle, where that one covers it. Triangles that share a node do not shelter each other, and a triangle seen
/// edge-on shelters none.
///
/// The centroids are sorted into a uniform grid across the stream, and each triangle looks at those in the cells that
/// it covers: O(triangles) for a mesh of even triangles in a few layers. Memory is taken by resize() only.
class WETCLOTH_EXPORT Shelter {
 public:
  /// Its three nodes.
  using Triangle = std::array<int, 3>;

  /// Takes the memory for so many.
  void resize(std::size_t nodes, std::size_t triangles);

  /// Looks at the triangles anew. As many nodes and triangles as resize() was told.
  /// @param direction  of the stream, of length 1
  void update(const std::vector<btVector3>& positions, const std::vector<Triangle>& triangles,
              const btVector3& direction);

  /// Whether another triangle covers this one's centroid, by the last update().
  bool isSheltered(std::size_t triangle) const { return m_isSheltered[triangle] != 0; }

 private:
  struct Point {
    double u;      // across the stream [m]
    double v;      // across the stream [m]
    double depth;  // along it [m]
  };
  struct Range {
    std::size_t first;
    std::size_t last;
  };

  void project(const std::vector<btVector3>& positions, const std::vector<Triangle>& triangles,
               const btVector3& direction);
  void layGrid();
  void sortIntoCells();
  void shelterBehind(const Triangle& triangle, const std::vector<Triangle>& triangles);
  Range columns(double from, double to) const;
  Range rows(double from, double to) const;
  std::size_t cellOf(const Point& point) const;

  std::vector<Point> m_points;     // of nodes
  std::vector<Point> m_centroids;  // of triangles
  std::vector<unsigned char> m_isSheltered;

  double m_left = 0;  // of the grid, its least u
  double m_bottom = 0;
  double m_cellSize = 1;  // [m]
  std::size_t m_columnCount = 1;
  std::size_t m_rowCount = 1;
  std::vector<std::size_t> m_firstInCell;  // in m_byCell; one more than cells
  std::vector<std::size_t> m_byCell;       // triangles
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
