// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/BodyMesh.h"

#include "bullet_wetcloth/bullet/Index.h"

#include <algorithm>
#include <array>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr int kNone = -1;
constexpr std::pair<int, int> kNoSide = {kNone, kNone};
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
void BodyMesh::findEdges(const ShapeFaces& shape) {
  m_sides.clear();
  m_lastSide.assign(shape.corners().size(), kNone);
  const auto isKnown = [&](const std::pair<int, int>& ends) {
    int side = m_lastSide[toSize(ends.first)];
    while (side != kNone && m_sides[toSize(side)].high != ends.second) side = m_sides[toSize(side)].before;
    return side != kNone;
  };
  for (std::size_t face = 0; face < shape.faces().size(); ++face) {
    const ShapeFaces::Face& of = shape.faces()[face];
    std::array<std::pair<int, int>, 3> sides;
    for (std::size_t k = 0; k < 3; ++k) {
      sides[k] = std::minmax({of.corner[k], of.corner[(k + 1) % 3]});
      if (!of.isEdge[k]) sides[k] = kNoSide;
    }
    std::sort(sides.begin(), sides.end());
    for (const auto& ends : sides) {
      if (ends == kNoSide || isKnown(ends)) continue;
      int& last = m_lastSide[toSize(ends.first)];
      m_sides.push_back({ends.first, ends.second, static_cast<int>(face), last});
      last = static_cast<int>(m_sides.size()) - 1;
    }
  }
}

void BodyMesh::add(const ShapeFaces& shape, const BodyPose& from, const BodyPose& to) {
  const int first = static_cast<int>(m_from.size());
  for (const BodyPoint& corner : shape.corners()) {
    m_from.push_back(from.outOf(corner));
    m_to.push_back(to.outOf(corner));
  }
  findEdges(shape);
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
