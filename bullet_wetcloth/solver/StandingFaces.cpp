// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/StandingFaces.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

// How deep in a body what the guard has kept outside may be, in roundings of a place.
constexpr double kRoundingsInside = 16;

double roundingOf(const BodyBox& box) {
  double farthest = 0;
  for (std::size_t k = 0; k < 3; ++k) farthest = std::max({farthest, std::fabs(box.low[k]), std::fabs(box.high[k])});
  return farthest * std::max(static_cast<double>(std::numeric_limits<btScalar>::epsilon()), 1e-12);
}

}  // namespace

void StandingFaces::add(const ClothGuard::Cloth& cloth, const BodyPoint& origin) {
  Cloth added = {cloth.mesh, m_places.size(), m_tiles.size(), {}, 0};
  const BodyPoint from = bodyPointOf(cloth.origin);
  for (int node = 0; node < cloth.nodeCount; ++node) {
    BodyPoint place;
    for (std::size_t k = 0; k < 3; ++k) {
      place[k] = static_cast<double>(cloth.nodes.position[k][cloth.slots[node]]) + (from[k] - origin[k]);
    }
    m_places.push_back(place);
    added.box.include(place);
  }
  added.depth = kRoundingsInside * roundingOf(added.box);
  for (const GuardMesh::Tile& tile : cloth.mesh->tiles) {
    BodyBox box;
    const int end = cloth.mesh->cells[toSize(tile.endCell)].face;
    for (int face = cloth.mesh->cells[toSize(tile.cell)].face; face < end; ++face) {
      for (const int node : cloth.mesh->faces[toSize(face)].node)
        box.include(m_places[added.firstPlace + toSize(node)]);
    }
    m_tiles.push_back(box);
  }
  m_cloths.push_back(added);
}

bool StandingFaces::isIn(const Cloth& cloth, const GuardMesh::Face& face, const BodyBox& box,
                         const ShapeFaces::Hull& hull, const BodyPose& body) {
  std::array<BodyPoint, 3> places;
  BodyBox around;
  for (std::size_t k = 0; k < 3; ++k) {
    places[k] = m_places[cloth.firstPlace + toSize(face.node[k])];
    around.include(places[k]);
  }
  if (!around.overlaps(box)) return false;
  for (BodyPoint& place : places) place = hull.pose.into(body.into(place));
  return m_crossing.isIn(places);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
