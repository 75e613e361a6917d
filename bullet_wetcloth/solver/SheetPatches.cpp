// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/SheetPatches.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/solver/GuardMesh.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr int kMostTrims = 30;
constexpr btScalar kBeyond = btScalar(1.01);     // of the farthest node that has to be in a patch
constexpr btScalar kLeastTurn = btScalar(0.35);  // least sine between a side of the border and the way to the middle

// A side of a face, in the direction in which its winding goes round.
struct FaceSide {
  int from;
  int to;
  int face;
};

// Across which side of a face there is which other one, wound alike; -1: none.
class FaceNeighbours {
 public:
  explicit FaceNeighbours(const GuardMesh& mesh) : m_across(3 * mesh.faces.size(), -1) {
    std::vector<std::array<int, 3>> sides;  // lower node, higher node, side
    for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
      for (std::size_t k = 0; k < 3; ++k) {
        const int a = mesh.faces[face].node[k];
        const int b = mesh.faces[face].node[(k + 1) % 3];
        sides.push_back({std::min(a, b), std::max(a, b), static_cast<int>(3 * face + k)});
      }
    }
    std::sort(sides.begin(), sides.end());
    for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
      while (end < sides.size() && sides[end][0] == sides[begin][0] && sides[end][1] == sides[begin][1]) ++end;
      if (end - begin == 2) join(mesh, sides[begin][2], sides[begin + 1][2]);
    }
  }
  int across(int face, std::size_t side) const { return m_across[3 * toSize(face) + side]; }

 private:
  void join(const GuardMesh& mesh, int one, int other) {
    const auto goesUp = [&](int side) {
      const GuardMesh::Face& face = mesh.faces[toSize(side / 3)];
      const bool isUp = face.node[side % 3] < face.node[(side + 1) % 3];
      return isUp == (mesh.windings[toSize(side / 3)] > 0);
    };
    if (mesh.windings[toSize(one / 3)] == 0 || mesh.windings[toSize(other / 3)] == 0) return;
    if (goesUp(one) == goesUp(other)) return;
    m_across[toSize(one)] = other / 3;
    m_across[toSize(other)] = one / 3;
  }
  std::vector<int> m_across;
};

class PatchMaker {
 public:
  PatchMaker(const GuardMesh& mesh, const std::vector<btVector3>& places)
      : m_mesh(mesh),
        m_places(places),
        m_neighbours(mesh),
        m_tileOfFace(mesh.faces.size()),
        m_isIn(mesh.faces.size()),
        m_patchOfNode(places.size()),
        m_facesOfTile(mesh.tiles.size()) {
    for (std::size_t tile = 0; tile < mesh.tiles.size(); ++tile) {
      for (int face = firstFace(static_cast<int>(tile)); face < endFace(static_cast<int>(tile)); ++face) {
        m_tileOfFace[toSize(face)] = static_cast<int>(tile);
      }
    }
  }
  // With all faces of these tiles, if there is one.
  void make(const std::vector<int>& tiles, std::vector<SheetPatch>& patches) {
    SheetPatch patch;
    findMiddle(tiles, patch);
    m_faces.clear();
    grow(patch.middle);
    for (int trim = 0; trim < kMostTrims; ++trim) {
      if (!hasAll(tiles)) break;
      findSides();
      if (!goesRound(patch)) continue;  // it is smaller now
      if (closeBorder(patch) && isDisc(patch)) {
        listTiles(patch);
        patches.push_back(patch);
      }
      break;
    }
    for (const int face : m_faces) m_isIn[toSize(face)] = 0;
  }
  // Those that share a node with it, and itself.
  std::vector<int> around(int tile) const {
    std::vector<int> tiles;
    for (int face = firstFace(tile); face < endFace(tile); ++face) {
      for (const int node : m_mesh.faces[toSize(face)].node) {
        const auto begin = m_mesh.tilesOfNodes.begin();
        tiles.insert(tiles.end(), begin + m_mesh.firstTileOfNode[toSize(node)],
                     begin + m_mesh.endTileOfNode[toSize(node)]);
      }
    }
    std::sort(tiles.begin(), tiles.end());
    tiles.erase(std::unique(tiles.begin(), tiles.end()), tiles.end());
    return tiles;
  }

 private:
  int firstFace(int tile) const { return m_mesh.cells[toSize(m_mesh.tiles[toSize(tile)].cell)].face; }
  int endFace(int tile) const { return m_mesh.cells[toSize(m_mesh.tiles[toSize(tile)].endCell)].face; }
  const btVector3& placeOf(int node) const { return m_places[toSize(node)]; }
  btVector3 normalOf(int face) const {
    const GuardMesh::Face& f = m_mesh.faces[toSize(face)];
    const btVector3 normal = (placeOf(f.node[1]) - placeOf(f.node[0])).cross(placeOf(f.node[2]) - placeOf(f.node[0]));
    return m_mesh.windings[toSize(face)] > 0 ? normal : -normal;
  }

  // The node that is nearest to the middle of the tiles, and how far a patch has to reach from it.
  void findMiddle(const std::vector<int>& tiles, SheetPatch& patch) {
    btVector3 sum(0, 0, 0);
    int count = 0;
    forEachNode(tiles, [&](int node) { sum += placeOf(node), ++count; });
    const btVector3 mean = sum / static_cast<btScalar>(std::max(count, 1));
    btScalar least = BT_LARGE_FLOAT;
    forEachNode(tiles, [&](int node) {
      const btScalar distance = placeOf(node).distance2(mean);
      if (distance < least) least = distance, patch.middle = node;
    });
    btScalar farthest = 0;
    forEachNode(tiles, [&](int node) { farthest = std::max(farthest, placeOf(node).distance(placeOf(patch.middle))); });
    m_reach = farthest * kBeyond;
    m_seed = -1;
    for (const int tile : tiles) {
      for (int face = firstFace(tile); face < endFace(tile); ++face) {
        const int(&nodes)[3] = m_mesh.faces[toSize(face)].node;
        if (std::find(std::begin(nodes), std::end(nodes), patch.middle) != std::end(nodes)) m_seed = face;
      }
    }
  }
  template <class Action>
  void forEachNode(const std::vector<int>& tiles, const Action& action) const {
    for (const int tile : tiles) {
      for (int face = firstFace(tile); face < endFace(tile); ++face) {
        for (const int node : m_mesh.faces[toSize(face)].node) action(node);
      }
    }
  }

  // All faces within reach that are joined to the first one by others.
  void grow(int middle) {
    if (m_seed < 0) return;
    const auto add = [&](int face) {
      if (m_isIn[toSize(face)]) return;
      for (const int node : m_mesh.faces[toSize(face)].node) {
        if (placeOf(node).distance(placeOf(middle)) > m_reach) return;
      }
      m_isIn[toSize(face)] = 1;
      m_faces.push_back(face);
    };
    spread(add);
  }
  // From the first face across sides to all that can be added.
  template <class Add>
  void spread(const Add& add) {
    add(m_seed);
    std::size_t next = 0;
    while (next < m_faces.size()) {
      const int face = m_faces[next++];
      for (std::size_t side = 0; side < 3; ++side) {
        const int beyond = m_neighbours.across(face, side);
        if (beyond >= 0) add(beyond);
      }
    }
  }
  bool hasAll(const std::vector<int>& tiles) const {
    for (const int tile : tiles) {
      for (int face = firstFace(tile); face < endFace(tile); ++face) {
        if (!m_isIn[toSize(face)]) return false;
      }
    }
    return true;
  }
  // Those at the border, as their faces go round.
  void findSides() {
    m_sides.clear();
    for (const int face : m_faces) {
      for (std::size_t k = 0; k < 3; ++k) {
        const int next = m_neighbours.across(face, k);
        if (next >= 0 && m_isIn[toSize(next)]) continue;
        const int a = m_mesh.faces[toSize(face)].node[k];
        const int b = m_mesh.faces[toSize(face)].node[(k + 1) % 3];
        const bool isForward = m_mesh.windings[toSize(face)] > 0;
        m_sides.push_back({isForward ? a : b, isForward ? b : a, face});
      }
    }
  }
  // What is no longer joined to the first face is taken out, too.
  void keepJoined() {
    std::vector<int> before;
    before.swap(m_faces);
    constexpr unsigned char kJoined = 2;
    const auto add = [&](int face) {
      if (m_isIn[toSize(face)] != 1) return;
      m_isIn[toSize(face)] = kJoined;
      m_faces.push_back(face);
    };
    spread(add);
    for (const int face : before) m_isIn[toSize(face)] = m_isIn[toSize(face)] == kJoined ? 1 : 0;
  }
  // Whether all sides go round the middle; faces with one that does not are taken out.
  bool goesRound(const SheetPatch& patch) {
    btVector3 normal(0, 0, 0);
    for (const int face : m_faces) normal += normalOf(face);
    const btVector3& middle = placeOf(patch.middle);
    bool goesRound = true;
    for (const FaceSide& side : m_sides) {
      const btVector3 a = placeOf(side.from) - middle;
      const btVector3 along = placeOf(side.to) - placeOf(side.from);
      if (a.cross(along).dot(normal) > kLeastTurn * a.length() * along.length() * normal.length()) continue;
      m_isIn[toSize(side.face)] = 0;
      goesRound = false;
    }
    if (!goesRound) keepJoined();
    return goesRound;
  }
  // One after the other; false: they are not one ring.
  bool closeBorder(SheetPatch& patch) {
    std::sort(m_sides.begin(), m_sides.end(), [](const FaceSide& a, const FaceSide& b) { return a.from < b.from; });
    patch.border.clear();
    if (m_sides.empty()) return false;
    int node = m_sides.front().from;
    do {
      const auto side = std::lower_bound(m_sides.begin(), m_sides.end(), node,
                                         [](const FaceSide& a, int from) { return a.from < from; });
      if (side == m_sides.end() || side->from != node || patch.border.size() == m_sides.size()) return false;
      patch.border.push_back(node);
      node = side->to;
    } while (node != patch.border.front());
    return patch.border.size() == m_sides.size();
  }
  // By Euler's number: V - E + F = 1, with 3 F = 2 E - border.
  bool isDisc(const SheetPatch& patch) {
    ++m_patch;
    std::size_t nodes = 0;
    for (const int face : m_faces) {
      for (const int node : m_mesh.faces[toSize(face)].node) {
        if (m_patchOfNode[toSize(node)] == m_patch) continue;
        m_patchOfNode[toSize(node)] = m_patch;
        ++nodes;
      }
    }
    const std::size_t edges = (3 * m_faces.size() + patch.border.size()) / 2;
    return nodes + m_faces.size() == edges + 1;
  }
  void listTiles(SheetPatch& patch) {
    for (const int face : m_faces) {
      const int tile = m_tileOfFace[toSize(face)];
      if (m_facesOfTile[toSize(tile)]++ == 0) patch.tiles.push_back(tile);
    }
    std::sort(patch.tiles.begin(), patch.tiles.end());
    for (const int tile : patch.tiles) {
      if (m_facesOfTile[toSize(tile)] == endFace(tile) - firstFace(tile)) patch.whole.push_back(tile);
      m_facesOfTile[toSize(tile)] = 0;
    }
  }

  const GuardMesh& m_mesh;
  const std::vector<btVector3>& m_places;
  FaceNeighbours m_neighbours;
  std::vector<int> m_tileOfFace;
  std::vector<unsigned char> m_isIn;  // of faces
  std::vector<int> m_faces;           // of the patch
  std::vector<FaceSide> m_sides;      // of its border
  btScalar m_reach = 0;
  int m_seed = -1;  // the first face
  // The last patch that each node was in, by number.
  std::vector<int> m_patchOfNode;
  int m_patch = 0;
  std::vector<int> m_facesOfTile;  // in a patch
};

}  // namespace

std::vector<SheetPatch> sheetPatchesOf(const GuardMesh& mesh, const std::vector<btVector3>& places) {
  std::vector<SheetPatch> patches;
  if (mesh.isGrid()) return patches;
  PatchMaker maker(mesh, places);
  for (int tile = 0; tile < static_cast<int>(mesh.tiles.size()); ++tile) {
    const std::vector<int> around = maker.around(tile);
    maker.make(around, patches);
    if (around.size() == 1) continue;
    maker.make({tile}, patches);
    for (const int next : around) {
      if (next > tile) maker.make({tile, next}, patches);
    }
  }
  return patches;
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
