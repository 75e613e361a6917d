// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/SupportPlanes.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/numerics/BestLanes.h"
#include "bullet_wetcloth/numerics/Lanes.h"
#include "bullet_wetcloth/numerics/Quad.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr btScalar kOneNormal = btScalar(1 - 1e-6);  // cosine between normals that are one
const btScalar kAlongAnyAxis = std::sqrt(btScalar(3));

btVector3 asVector(const GuardNodes::Place& place) { return btVector3(place.at[0], place.at[1], place.at[2]); }
btVector3 middleOfWay(const GuardNodes::Way& way) { return (asVector(way.start) + asVector(way.end)) / 2; }

}  // namespace

void SupportPlanes::begin(const GuardNodes& nodes, btScalar near) {
  m_nodes = &nodes;
  m_near = near;
  forget();
}

void SupportPlanes::forget() {
  for (Shell& shell : m_shells) {
    shell.isFound = false;
    shell.last = 0;
  }
}

bool SupportPlanes::areBeyond(const int* nodes, int count, const GuardMesh& mesh, int number, int firstNode) {
  if (m_shells.size() <= toSize(number)) m_shells.resize(toSize(number) + 1);
  Shell& shell = m_shells[toSize(number)];
  if (!shell.isFound) find(mesh, mesh.shells[toSize(number)], firstNode, shell);
  if (shell.blocks.empty()) return false;
  btScalar slack = 0;
  for (int k = 0; k < count; ++k) slack = std::max(slack, m_nodes->expected[toSize(nodes[k])].start.at[3]);
  const Part part = {nodes, count, m_near + kAlongAnyAxis * slack};
  if (isBeyond(part, shell, shell.last)) return true;
  const std::size_t best = farthest(shell, middleOf(part));
  if (best == shell.last || !isBeyond(part, shell, best)) return false;
  shell.last = best;
  return true;
}

bool SupportPlanes::isBeyond(const Part& part, const Shell& shell, std::size_t plane) const {
  const Block& block = shell.blocks[plane / kLanes];
  const std::size_t lane = plane % kLanes;
  const btVector3 normal(block.normal[0][lane], block.normal[1][lane], block.normal[2][lane]);
  for (int k = 0; k < part.count; ++k) {
    const GuardNodes::Way& way = m_nodes->expected[toSize(part.nodes[k])];
    if (!(normal.dot(asVector(way.start)) - block.offset[0][lane] > part.distance)) return false;
    if (!(normal.dot(asVector(way.end)) - block.offset[1][lane] > part.distance)) return false;
  }
  return true;
}

btVector3 SupportPlanes::middleOf(const Part& part) const {
  btVector3 sum(0, 0, 0);
  for (int k = 0; k < part.count; ++k) {
    const GuardNodes::Way& way = m_nodes->expected[toSize(part.nodes[k])];
    sum += asVector(way.start);
    sum += asVector(way.end);
  }
  return sum / static_cast<btScalar>(2 * part.count);
}

// Of each lane the block whose plane a point is farthest beyond, and how far [m].
struct SupportPlanes::Farthest {
  const std::vector<Block>& blocks;
  const btVector3& point;
  btScalar (&most)[kLanes];
  btScalar (&where)[kLanes];

  template <class Lanes>
  WETCLOTH_INLINE void run() const {
    const Lanes x = everywhere<Lanes>(point.x());
    const Lanes y = everywhere<Lanes>(point.y());
    const Lanes z = everywhere<Lanes>(point.z());
    for (std::size_t lane = 0; lane < kLanes; lane += kLaneCount<Lanes>) {
      Lanes farthest = everywhere<Lanes>(-std::numeric_limits<btScalar>::infinity());
      Lanes at = everywhere<Lanes>(0);
      for (std::size_t b = 0; b < blocks.size(); ++b) {
        const Block& block = blocks[b];
        const Lanes distance = load<Lanes>(block.normal[0] + lane) * x + load<Lanes>(block.normal[1] + lane) * y +
                               load<Lanes>(block.normal[2] + lane) * z - load<Lanes>(block.offset[0] + lane);
        at = choose(distance > farthest, everywhere<Lanes>(static_cast<btScalar>(b)), at);
        farthest = choose(distance > farthest, distance, farthest);
      }
      store(most + lane, farthest);
      store(where + lane, at);
    }
  }
};

// The plane that a point is farthest beyond, or least behind.
std::size_t SupportPlanes::farthest(const Shell& shell, const btVector3& point) {
  btScalar most[kLanes];
  btScalar where[kLanes];
  runOnBestLanes(Farthest{shell.blocks, point, most, where});
  const std::size_t best = static_cast<std::size_t>(std::max_element(most, most + kLanes) - most);
  return static_cast<std::size_t>(where[best]) * kLanes + best;
}

// How far the body reaches along the normals of a block at the start and at the end. In between it reaches no farther
// than on the straight way from one to the other, since the farthest of places that go straight is a convex function
// of time.
struct SupportPlanes::Support {
  const GuardNodes::Way* begin;
  const GuardNodes::Way* end;
  btScalar slack;
  Block& block;

  template <class Lanes>
  WETCLOTH_INLINE void run() const {
    for (std::size_t lane = 0; lane < kLanes; lane += kLaneCount<Lanes>) {
      const Lanes normal[3] = {load<Lanes>(block.normal[0] + lane), load<Lanes>(block.normal[1] + lane),
                               load<Lanes>(block.normal[2] + lane)};
      Lanes start = everywhere<Lanes>(-std::numeric_limits<btScalar>::infinity());
      Lanes finish = start;
      for (const GuardNodes::Way* way = begin; way != end; ++way) {
        start = greater(along(normal, way->start), start);
        finish = greater(along(normal, way->end), finish);
      }
      store(block.offset[0] + lane, start + everywhere<Lanes>(slack));
      store(block.offset[1] + lane, finish + everywhere<Lanes>(slack));
    }
  }

 private:
  template <class Lanes>
  WETCLOTH_INLINE static Lanes along(const Lanes (&normal)[3], const GuardNodes::Place& place) {
    return normal[0] * everywhere<Lanes>(place.at[0]) + normal[1] * everywhere<Lanes>(place.at[1]) +
           normal[2] * everywhere<Lanes>(place.at[2]);
  }
};

struct SupportPlanes::SameNormal {
  const std::vector<Block>& blocks;
  const btVector3& normal;
  bool& isThere;

  template <class Lanes>
  WETCLOTH_INLINE void run() const {
    const Lanes least = everywhere<Lanes>(kOneNormal);
    const Lanes x = everywhere<Lanes>(normal.x());
    const Lanes y = everywhere<Lanes>(normal.y());
    const Lanes z = everywhere<Lanes>(normal.z());
    unsigned same = 0;
    for (const Block& block : blocks) {
      for (std::size_t lane = 0; lane < kLanes; lane += kLaneCount<Lanes>) {
        const Lanes along = load<Lanes>(block.normal[0] + lane) * x + load<Lanes>(block.normal[1] + lane) * y +
                            load<Lanes>(block.normal[2] + lane) * z;
        same |= bitsOfLanes<Lanes>(along > least);
      }
    }
    isThere = same != 0;
  }
};

bool SupportPlanes::hasNormal(const Shell& shell, const btVector3& normal) {
  bool isThere = false;
  runOnBestLanes(SameNormal{shell.blocks, normal, isThere});
  return isThere;
}

void SupportPlanes::find(const GuardMesh& mesh, const GuardMesh::Shell& of, int firstNode, Shell& shell) const {
  const GuardNodes::Way* const ways = &m_nodes->expected[toSize(firstNode)];
  shell.isFound = true;
  shell.blocks.clear();
  btVector3 centre(0, 0, 0);
  btScalar slack = 0;
  for (int node = of.node; node < of.endNode; ++node) {
    centre += middleOfWay(ways[node]) / static_cast<btScalar>(of.endNode - of.node);
    slack = std::max(slack, ways[node].start.at[3]);
  }
  std::size_t count = 0;
  for (int face = of.face; face < of.endFace; ++face) {
    const int(&nodes)[3] = mesh.faces[toSize(face)].node;
    const btVector3 corner = middleOfWay(ways[nodes[0]]);
    btVector3 normal = (middleOfWay(ways[nodes[1]]) - corner).cross(middleOfWay(ways[nodes[2]]) - corner);
    const btScalar length = normal.length();
    if (!(length > 0)) continue;
    normal /= normal.dot(corner - centre) < 0 ? -length : length;
    if (hasNormal(shell, normal)) continue;  // of one polygon
    const std::size_t first = count++ % kLanes;
    if (first == 0) shell.blocks.emplace_back();
    Block& block = shell.blocks.back();
    for (std::size_t lane = first; lane < kLanes; ++lane) {
      for (int axis = 0; axis < 3; ++axis) block.normal[axis][lane] = normal[axis];
    }
  }
  for (Block& block : shell.blocks) {
    runOnBestLanes(Support{ways + of.node, ways + of.endNode, kAlongAnyAxis * slack, block});
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
