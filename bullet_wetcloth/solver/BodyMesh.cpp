// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/BodyMesh.h"

#include "bullet_wetcloth/bullet/Index.h"

#include <algorithm>
#include <tuple>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr std::size_t kFacesInTile = 64;         // unless they are a shell
constexpr std::size_t kMostFacesOfShell = 1000;  // planes are measured from all corners

}  // namespace

void BodyMesh::clear() {
  m_mesh.vertices.clear();
  m_mesh.edges.clear();
  m_mesh.faces.clear();
  m_mesh.cells.clear();
  m_mesh.tiles.clear();
  m_mesh.shells.clear();
  m_mesh.shellOfTile.clear();
  m_from.clear();
  m_to.clear();
}

// Each edge once, at the first of its faces, in the order of these.
void BodyMesh::findEdges(const std::vector<ShapeFaces::Face>& faces) {
  m_sides.clear();
  for (std::size_t face = 0; face < faces.size(); ++face) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (!faces[face].isEdge[k]) continue;
      const auto ends = std::minmax(faces[face].corner[k], faces[face].corner[(k + 1) % 3]);
      m_sides.push_back({ends.first, ends.second, static_cast<int>(face)});
    }
  }
  std::sort(m_sides.begin(), m_sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.face) < std::tie(b.low, b.high, b.face);
  });
  const auto isSame = [](const Side& a, const Side& b) { return a.low == b.low && a.high == b.high; };
  m_sides.erase(std::unique(m_sides.begin(), m_sides.end(), isSame), m_sides.end());
  std::sort(m_sides.begin(), m_sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.face, a.low, a.high) < std::tie(b.face, b.low, b.high);
  });
}

void BodyMesh::add(const ShapeFaces& shape, const BodyPose& from, const BodyPose& to) {
  const int first = static_cast<int>(m_from.size());
  for (const BodyPoint& corner : shape.corners()) {
    m_from.push_back(from.outOf(corner));
    m_to.push_back(to.outOf(corner));
  }
  findEdges(shape.faces());
  m_hasVertex.assign(shape.corners().size(), 0);
  std::size_t side = 0;
  const bool isShell = shape.hulls().size() == 1 && shape.faces().size() <= kMostFacesOfShell;
  const int shell = isShell ? static_cast<int>(m_mesh.shells.size()) : -1;
  const int firstFace = static_cast<int>(m_mesh.faces.size());
  for (std::size_t face = 0; face < shape.faces().size(); ++face) {
    const int cell = static_cast<int>(m_mesh.cells.size());
    if (isShell ? face == 0 : face % kFacesInTile == 0) {
      m_mesh.tiles.push_back({cell, cell, false});
      m_mesh.shellOfTile.push_back(shell);
    }
    m_mesh.tiles.back().endCell = cell + 1;
    m_mesh.cells.push_back({static_cast<int>(m_mesh.vertices.size()), static_cast<int>(m_mesh.edges.size()),
                            static_cast<int>(m_mesh.faces.size()), 0, 0});
    const int(&corner)[3] = shape.faces()[face].corner;
    for (const int k : corner) {
      if (m_hasVertex[toSize(k)] == 0) m_mesh.vertices.push_back(first + k);
      m_hasVertex[toSize(k)] = 1;
    }
    for (; side < m_sides.size() && m_sides[side].face == static_cast<int>(face); ++side) {
      m_mesh.edges.push_back({{first + m_sides[side].low, first + m_sides[side].high}});
    }
    m_mesh.faces.push_back({{first + corner[0], first + corner[1], first + corner[2]}});
  }
  if (isShell) {
    m_mesh.shells.push_back({first, static_cast<int>(m_from.size()), firstFace, static_cast<int>(m_mesh.faces.size())});
  }
}

void BodyMesh::finish() {
  m_mesh.cells.push_back({static_cast<int>(m_mesh.vertices.size()), static_cast<int>(m_mesh.edges.size()),
                          static_cast<int>(m_mesh.faces.size()), 0, 0});
  m_mesh.findTilesOfNodes(static_cast<int>(m_from.size()));
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
