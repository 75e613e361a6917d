// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/solver/BodyPose.h"
#include "bullet_wetcloth/solver/ClothGuard.h"
#include "bullet_wetcloth/solver/HullCrossing.h"
#include "bullet_wetcloth/solver/ShapeFaces.h"

#include <array>
#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Which faces of cloths reach into a convex part of a body.
class StandingFaces {
 public:
  void clear() {
    m_cloths.clear();
    m_places.clear();
    m_tiles.clear();
  }
  /// One more cloth, as it is now. Places are relative to this origin.
  void add(const ClothGuard::Cloth& cloth, const BodyPoint& origin);
  /// Calls action(face) for the faces of a cloth, in the order of add(), that reach into the hull of a body.
  template <class Action>
  void forEachIn(std::size_t cloth, const ShapeFaces::Hull& hull, const BodyPose& body, const Action& action) {
    const Cloth& of = m_cloths[cloth];
    const BodyBox box = boxOutOf(body, boxOutOf(hull.pose, hull.hull->box));
    if (!of.box.overlaps(box)) return;
    m_crossing.begin(*hull.hull, of.depth);
    for (std::size_t k = 0; k < of.mesh->tiles.size(); ++k) {
      if (!m_tiles[of.firstTile + k].overlaps(box)) continue;
      const int end = of.mesh->cells[toSize(of.mesh->tiles[k].endCell)].face;
      for (int face = of.mesh->cells[toSize(of.mesh->tiles[k].cell)].face; face < end; ++face) {
        const GuardMesh::Face& nodes = of.mesh->faces[toSize(face)];
        if (isIn(of, nodes, box, hull, body)) action(nodes);
      }
    }
  }

 private:
  struct Cloth {
    const GuardMesh* mesh;
    std::size_t firstPlace;
    std::size_t firstTile;
    BodyBox box;
    double depth;  // that rounding may bring a face into a hull [m]
  };
  bool isIn(const Cloth& cloth, const GuardMesh::Face& face, const BodyBox& box, const ShapeFaces::Hull& hull,
            const BodyPose& body);

  std::vector<Cloth> m_cloths;
  std::vector<BodyPoint> m_places;  // of nodes
  std::vector<BodyBox> m_tiles;
  HullCrossing m_crossing;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
