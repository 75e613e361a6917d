// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/PatchBounds.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/numerics/Quad.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr btScalar kLeastUp = btScalar(0.05);  // of a normal near 1: far beyond rounding
const btScalar kAlongAny = std::sqrt(btScalar(3));

WETCLOTH_INLINE Quad cross(const Quad& a, const Quad& b) { return turnAxes(a * turnAxes(b) - turnAxes(a) * b); }

// A side of a face at the start and the end of its way.
struct SideWay {
  Quad start;
  Quad end;

  WETCLOTH_INLINE SideWay(const GuardNodes::Way& from, const GuardNodes::Way& to)
      : start(load<Quad>(to.start.at) - load<Quad>(from.start.at)),
        end(load<Quad>(to.end.at) - load<Quad>(from.end.at)) {}
  WETCLOTH_INLINE Quad longest() const { return greater(absolute(start), absolute(end)); }
};

// A vector in a plane on its way, and how far it may be from it.
struct PlaneWay {
  btScalar start[2];
  btScalar end[2];
  btScalar slack;

  // At most.
  btScalar length() const { return std::max(lengthOf(start), lengthOf(end)); }
  // The least that its product with another one can be. The product of two ways is between those of their starts, of
  // their ends, and the mean of those across.
  btScalar leastCross(const PlaneWay& other) const {
    const btScalar across = (cross(start, other.end) + cross(end, other.start)) / 2;
    return std::min({cross(start, other.start), cross(end, other.end), across}) - slack * other.length() -
           other.slack * length() - slack * other.slack;
  }
  PlaneWay to(const PlaneWay& other) const {
    PlaneWay way;
    for (int k = 0; k < 2; ++k) {
      way.start[k] = other.start[k] - start[k];
      way.end[k] = other.end[k] - end[k];
    }
    way.slack = slack + other.slack;
    return way;
  }

 private:
  static btScalar cross(const btScalar (&a)[2], const btScalar (&b)[2]) { return a[0] * b[1] - a[1] * b[0]; }
  static btScalar lengthOf(const btScalar (&a)[2]) {
    const btScalar x = std::fabs(a[0]);
    const btScalar y = std::fabs(a[1]);
    return std::max(x, y) + std::min(x, y) / 2;  // no less than the root
  }
};

// Two axes across a direction.
struct View {
  btVector3 axis[2];

  explicit View(const btVector3& direction) {
    btPlaneSpace1(direction, axis[0], axis[1]);
    if (axis[0].cross(axis[1]).dot(direction) < 0) axis[1] = -axis[1];
  }
  // Relative to where a node starts and ends.
  PlaneWay wayOf(const GuardNodes::Way& node, const GuardNodes::Way& origin) const {
    PlaneWay way;
    const btVector3 start = vectorOf(node.start, origin.start);
    const btVector3 end = vectorOf(node.end, origin.end);
    for (int k = 0; k < 2; ++k) {
      way.start[k] = axis[k].dot(start);
      way.end[k] = axis[k].dot(end);
    }
    way.slack = kAlongAny * node.start.at[3];
    return way;
  }

 private:
  static btVector3 vectorOf(const GuardNodes::Place& to, const GuardNodes::Place& from) {
    return btVector3(to.at[0] - from.at[0], to.at[1] - from.at[1], to.at[2] - from.at[2]);
  }
};

}  // namespace

GuardBox normalsOfTile(const GuardMesh& mesh, int tile, const GuardNodes& nodes, int firstNode) {
  GuardBox box;
  const GuardMesh::Tile& cells = mesh.tiles[toSize(tile)];
  const int end = mesh.cells[toSize(cells.endCell)].face;
  for (int face = mesh.cells[toSize(cells.cell)].face; face < end; ++face) {
    const int(&corners)[3] = mesh.faces[toSize(face)].node;
    const GuardNodes::Way& a = nodes.expected[toSize(firstNode + corners[0])];
    const GuardNodes::Way& b = nodes.expected[toSize(firstNode + corners[1])];
    const GuardNodes::Way& c = nodes.expected[toSize(firstNode + corners[2])];
    const SideWay u(a, b);
    const SideWay v(a, c);
    const Quad scale = everywhere<Quad>(mesh.windings[toSize(face)]);
    // The product of two ways is between those of their starts, of their ends, and the mean of those across.
    const Quad products[3] = {
        cross(u.start, v.start) * scale, cross(u.end, v.end) * scale,
        (cross(u.start, v.end) + cross(u.end, v.start)) * scale * everywhere<Quad>(btScalar(0.5))};
    const Quad off = everywhere<Quad>(2 * std::max({a.start.at[3], b.start.at[3], c.start.at[3]}));
    const Quad sides = u.longest() + v.longest();
    const Quad wrong = (off * (turnAxes(sides) + turnAxes(turnAxes(sides))) + off * off + off * off) * absolute(scale);
    for (const Quad& product : products) {
      box.include(product - wrong);
      box.include(product + wrong);
    }
  }
  return box;
}

bool cannotMeetItself(const SheetPatch& patch, const GuardBox* normals, const GuardNodes& nodes, int firstNode) {
  const Quad half = everywhere<Quad>(btScalar(0.5));
  Quad sum = everywhere<Quad>(0);
  for (const int tile : patch.tiles) sum = sum + (normals[tile].low + normals[tile].high) * half;
  btVector3 up(sum[0], sum[1], sum[2]);
  const btScalar length = up.length();
  if (!(length > 0)) return false;
  up /= length;
  for (const int tile : patch.tiles) {
    btScalar least = 0;
    for (int k = 0; k < 3; ++k) least += up[k] * (up[k] > 0 ? normals[tile].low[k] : normals[tile].high[k]);
    if (!(least > kLeastUp)) return false;
  }
  const View view(up);
  const GuardNodes::Way* const ways = nodes.expected.data() + firstNode;
  const PlaneWay middle = view.wayOf(ways[patch.middle], ways[patch.middle]);
  PlaneWay here = view.wayOf(ways[patch.border.back()], ways[patch.middle]);
  int rounds = 0;
  for (const int node : patch.border) {
    const PlaneWay next = view.wayOf(ways[node], ways[patch.middle]);
    if (!(middle.to(here).leastCross(here.to(next)) > 0)) return false;
    if (here.start[1] < 0 && next.start[1] >= 0) ++rounds;
    here = next;
  }
  return rounds == 1;
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
