// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/BodyPose.h"
#include "bullet_wetcloth/solver/ClothGuard.h"

#include <array>
#include <optional>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// An edge that goes through a face, of one cloth or of two. Nodes are numbered as those of all cloths, one cloth after
/// the other; what shares a node, or has two that count as one, does not cross.
struct Crossing {
  std::array<int, 2> edge;
  std::array<int, 3> face;
  std::array<int, 2> beside;  ///< the third nodes of the faces that have the edge; -1: there is none
  std::array<int, 2> cloth;   ///< of the edge, and of the face
};

/// Where an edge goes through a face.
struct CrossingPoint {
  double along;                  ///< share of the way from the edge's first node to its second
  std::array<double, 3> weight;  ///< of the face's nodes, whose sum is 1
};

/// The point at which the edge pq goes through the face abc, if it does. Computed in double; what only touches may
/// cross or not.
std::optional<CrossingPoint> crossingPoint(const BodyPoint& p, const BodyPoint& q, const BodyPoint& a,
                                           const BodyPoint& b, const BodyPoint& c);

/// Where a node of a cloth is now, relative to this origin [m].
inline BodyPoint crossingPlaceOf(const ClothGuard::Cloth& cloth, int node, const btVector3& origin) {
  BodyPoint place;
  for (int k = 0; k < 3; ++k) {
    place[static_cast<std::size_t>(k)] = static_cast<double>(cloth.nodes.position[k][cloth.slots[node]]) +
                                         static_cast<double>(cloth.origin[k] - origin[k]);
  }
  return place;
}

/// Finds all crossings of some cloths.
class Crossings {
 public:
  /// Where the cloths are now, as far as these parameters want them kept apart.
  void find(const std::vector<ClothGuard::Cloth>& cloths, const ClothSolver::Guard& parameters);
  const std::vector<Crossing>& found() const { return m_found; }
  /// Counts nodes as one again that have just come apart where sides of a cut cross, and leaves out these crossings.
  void joinCuts(const std::vector<ClothGuard::Cloth>& cloths);

 private:
  // A face, or an edge whose third corner is its second.
  struct Part {
    std::array<int, 3> node;
    BodyBox box;
  };
  // A tile of a cloth's mesh. Its faces are in the order in which they begin along its longest side.
  struct Tile {
    int cloth;
    std::size_t edge, endEdge;
    std::size_t face, endFace;
    BodyBox box;
    std::size_t axis;
    double longest;  // face along it [m]
  };

  void add(const ClothGuard::Cloth& cloth, int number, const btVector3& origin);
  Part part(const std::array<int, 3>& nodes) const;
  void sortFaces(Tile& tile);
  bool cross(const Part& edge, const Part& face) const;
  void findIn(const Tile& edges, const Tile& faces, const std::vector<ClothGuard::Cloth>& cloths);

  std::vector<int> m_first;  // node of each cloth
  CoincidentExemptions m_coincident;
  std::vector<BodyPoint> m_places;
  std::vector<Part> m_faces;
  std::vector<Part> m_edges;
  std::vector<Tile> m_tiles;
  std::vector<Crossing> m_found;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
