// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/numerics/Shelter.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

double dot(const btVector3& a, const btVector3& b) {
  return static_cast<double>(a.x()) * static_cast<double>(b.x()) +
         static_cast<double>(a.y()) * static_cast<double>(b.y()) +
         static_cast<double>(a.z()) * static_cast<double>(b.z());
}

// Cell of a coordinate; outside of the grid, the nearest one.
std::size_t cellAlong(double distance, double cellSize, std::size_t count) {
  const double cell = distance / cellSize;
  if (!(cell > 0)) return 0;
  return cell < static_cast<double>(count) ? static_cast<std::size_t>(cell) : count - 1;
}

bool shareANode(const Shelter::Triangle& a, const Shelter::Triangle& b) {
  return std::any_of(a.begin(), a.end(), [&](int node) { return node == b[0] || node == b[1] || node == b[2]; });
}

// A point on the border of two triangles is covered by at least one of them, whatever the rounding.
constexpr double kBorder = 1e-9;

}  // namespace

void Shelter::resize(std::size_t nodes, std::size_t triangles) {
  m_points.resize(nodes);
  m_centroids.resize(triangles);
  m_isSheltered.assign(triangles, 0);
  m_byCell.resize(triangles);
  m_firstInCell.resize(3 * triangles + 3);  // see layGrid()
}

void Shelter::update(const std::vector<btVector3>& positions, const std::vector<Triangle>& triangles,
                     const btVector3& direction) {
  std::fill(m_isSheltered.begin(), m_isSheltered.end(), static_cast<unsigned char>(0));
  project(positions, triangles, direction);
  layGrid();
  sortIntoCells();
  for (const Triangle& triangle : triangles) shelterBehind(triangle, triangles);
}

void Shelter::project(const std::vector<btVector3>& positions, const std::vector<Triangle>& triangles,
                      const btVector3& direction) {
  btVector3 across;
  btVector3 acrossBoth;
  btPlaneSpace1(direction, across, acrossBoth);
  for (std::size_t i = 0; i < m_points.size(); ++i) {
    m_points[i] = {dot(positions[i], across), dot(positions[i], acrossBoth), dot(positions[i], direction)};
  }
  for (std::size_t f = 0; f < m_centroids.size(); ++f) {
    const Point& a = m_points[static_cast<std::size_t>(triangles[f][0])];
    const Point& b = m_points[static_cast<std::size_t>(triangles[f][1])];
    const Point& c = m_points[static_cast<std::size_t>(triangles[f][2])];
    m_centroids[f] = {(a.u + b.u + c.u) / 3, (a.v + b.v + c.v) / 3, (a.depth + b.depth + c.depth) / 3};
  }
}

// With n triangles, width w and height h, cells of sqrt(w h / n), and at least max(w, h) / n, are no more than
// (w / s + 1) (h / s + 1) <= n + 2 n + 1.
void Shelter::layGrid() {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  double right = -kFar;
  double top = -kFar;
  m_left = m_bottom = kFar;
  for (const Point& point : m_centroids) {
    if (!std::isfinite(point.u + point.v)) continue;
    m_left = std::min(m_left, point.u);
    m_bottom = std::min(m_bottom, point.v);
    right = std::max(right, point.u);
    top = std::max(top, point.v);
  }
  const double width = right - m_left;
  const double height = top - m_bottom;
  const double count = static_cast<double>(m_centroids.size());
  m_cellSize = std::max(std::sqrt(width / count) * std::sqrt(height), std::max(width, height) / count);
  const bool isGrid = std::isfinite(m_cellSize) && m_cellSize > 0;  // not one point, or nothing finite
  if (!isGrid) m_cellSize = 1;
  m_columnCount = isGrid ? static_cast<std::size_t>(width / m_cellSize) + 1 : 1;
  m_rowCount = isGrid ? static_cast<std::size_t>(height / m_cellSize) + 1 : 1;
  m_rowCount = std::min(m_rowCount, std::max<std::size_t>((m_firstInCell.size() - 1) / m_columnCount, 1));
}

void Shelter::sortIntoCells() {
  const std::size_t cells = m_columnCount * m_rowCount;
  const auto begin = m_firstInCell.begin();
  std::fill(begin, begin + static_cast<std::ptrdiff_t>(cells) + 1, std::size_t{0});
  for (const Point& point : m_centroids) ++m_firstInCell[cellOf(point)];
  for (std::size_t cell = 1; cell <= cells; ++cell) m_firstInCell[cell] += m_firstInCell[cell - 1];
  // From the end of each cell to its beginning, so that what is left are the beginnings.
  for (std::size_t f = m_centroids.size(); f-- > 0;) m_byCell[--m_firstInCell[cellOf(m_centroids[f])]] = f;
}

void Shelter::shelterBehind(const Triangle& triangle, const std::vector<Triangle>& triangles) {
  const Point& a = m_points[static_cast<std::size_t>(triangle[0])];
  const Point& b = m_points[static_cast<std::size_t>(triangle[1])];
  const Point& c = m_points[static_cast<std::size_t>(triangle[2])];
  const double twiceArea = (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
  if (!(twiceArea != 0 && std::isfinite(twiceArea))) return;
  const Range inColumns = columns(std::min({a.u, b.u, c.u}), std::max({a.u, b.u, c.u}));
  const Range inRows = rows(std::min({a.v, b.v, c.v}), std::max({a.v, b.v, c.v}));
  for (std::size_t row = inRows.first; row <= inRows.last; ++row) {
    const std::size_t begin = m_firstInCell[row * m_columnCount + inColumns.first];
    const std::size_t end = m_firstInCell[row * m_columnCount + inColumns.last + 1];
    for (std::size_t k = begin; k < end; ++k) {
      const std::size_t other = m_byCell[k];
      const Point& p = m_centroids[other];
      const double inB = ((p.u - a.u) * (c.v - a.v) - (p.v - a.v) * (c.u - a.u)) / twiceArea;
      const double inC = ((b.u - a.u) * (p.v - a.v) - (b.v - a.v) * (p.u - a.u)) / twiceArea;
      const double inA = 1 - inB - inC;
      if (!(inA >= -kBorder && inB >= -kBorder && inC >= -kBorder)) continue;
      if (inA * a.depth + inB * b.depth + inC * c.depth < p.depth && !shareANode(triangle, triangles[other])) {
        m_isSheltered[other] = 1;
      }
    }
  }
}

Shelter::Range Shelter::columns(double from, double to) const {
  return {cellAlong(from - m_left, m_cellSize, m_columnCount), cellAlong(to - m_left, m_cellSize, m_columnCount)};
}

Shelter::Range Shelter::rows(double from, double to) const {
  return {cellAlong(from - m_bottom, m_cellSize, m_rowCount), cellAlong(to - m_bottom, m_cellSize, m_rowCount)};
}

std::size_t Shelter::cellOf(const Point& point) const {
  return cellAlong(point.v - m_bottom, m_cellSize, m_rowCount) * m_columnCount +
         cellAlong(point.u - m_left, m_cellSize, m_columnCount);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
