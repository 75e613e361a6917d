// SPDX-License-Identifier: Zlib
#include "command/scene/ColliderSurface.h"

#include <LinearMath/btConvexHullComputer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>

namespace command {
namespace {

using Piece = ColliderSurface::Piece;
using Normal = std::function<btVector3(const btVector3&)>;

constexpr int sectors = 64;
constexpr int rings = 32;
/// Where two faces of a mesh bend by less than this their edge is drawn round.
constexpr double creaseDegrees = 40;

std::size_t asIndex(int number) { return static_cast<std::size_t>(number); }

btVector3 flatNormal(const std::vector<btVector3>& corners) {
  const btVector3 across = corners.size() == 3 ? (corners[1] - corners[0]).cross(corners[2] - corners[0])
                                               : (corners[2] - corners[0]).cross(corners[3] - corners[1]);
  return across.length() > 0 ? across.normalized() : btVector3(0, 1, 0);
}

/// A strip round an axis between two circles; where one is a point its pieces are triangles all the same.
struct Round {
  btVector3 u, v;  // across the axis, of length 1, u x v along it

  explicit Round(const btVector3& axis) { btPlaneSpace1(axis, u, v); }

  btVector3 towards(int sector) const {
    const double angle = SIMD_2_PI * btScalar(sector) / sectors;
    return u * btScalar(std::cos(angle)) + v * btScalar(std::sin(angle));
  }
  void addStrip(const btVector3& low, double lowRadius, const btVector3& high, double highRadius, const Normal& normal,
                std::vector<Piece>& pieces) const {
    for (int sector = 0; sector < sectors; ++sector) {
      const btVector3 right = towards(sector), left = towards(sector + 1);
      Piece piece;
      piece.corners = {low + right * btScalar(lowRadius), low + left * btScalar(lowRadius),
                       high + left * btScalar(highRadius), high + right * btScalar(highRadius)};
      for (const btVector3& corner : piece.corners) piece.normals.push_back(normal(corner));
      pieces.push_back(std::move(piece));
    }
  }
};

/// A ball drawn out along an axis from one centre to another.
void addRounded(const btVector3& from, const btVector3& to, double radius, const btVector3& axis,
                std::vector<Piece>& pieces) {
  const Round round(axis);
  const auto height = [&](int ring) { return -std::cos(SIMD_PI * btScalar(ring) / rings) * btScalar(radius); };
  const auto reach = [&](int ring) { return std::sin(SIMD_PI * btScalar(ring) / rings) * btScalar(radius); };
  const btScalar length = (to - from).length();
  const Normal normal = [&](const btVector3& corner) {
    const btScalar along = std::min(length, std::max(btScalar(0), (corner - from).dot(axis)));
    return (corner - (from + axis * along)).normalized();
  };
  for (int ring = 0; ring < rings; ++ring) {
    if (ring == rings / 2 && length > 0) round.addStrip(from, radius, to, radius, normal, pieces);
    const btVector3& centre = ring < rings / 2 ? from : to;
    round.addStrip(centre + axis * btScalar(height(ring)), static_cast<double>(reach(ring)),
                   centre + axis * btScalar(height(ring + 1)), static_cast<double>(reach(ring + 1)), normal, pieces);
  }
}

/// Normals of pieces that meet at a corner are averaged where the surface bends little.
void addFaces(const std::vector<btVector3>& vertices, const std::vector<std::vector<int>>& faces,
              std::vector<Piece>& pieces) {
  std::vector<std::vector<std::size_t>> facesAt(vertices.size());
  std::vector<btVector3> normals;
  const std::size_t before = pieces.size();
  for (const std::vector<int>& face : faces) {
    Piece piece;
    for (const int corner : face) {
      piece.corners.push_back(vertices[asIndex(corner)]);
      facesAt[asIndex(corner)].push_back(normals.size());
    }
    normals.push_back(flatNormal(piece.corners));
    pieces.push_back(std::move(piece));
  }
  const btScalar alike = btScalar(std::cos(creaseDegrees * SIMD_RADS_PER_DEG));
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (const int corner : faces[f]) {
      btVector3 sum(0, 0, 0);
      for (const std::size_t other : facesAt[asIndex(corner)]) {
        if (normals[other].dot(normals[f]) > alike) sum += normals[other];
      }
      pieces[before + f].normals.push_back(sum.normalized());
    }
  }
}

/// As triangles: corners in turn, counter-clockwise from outside.
std::vector<std::vector<int>> facesOfHull(std::vector<btVector3>& points) {
  btConvexHullComputer computer;
  computer.compute(&points.front().m_floats[0], static_cast<int>(sizeof(btVector3)), static_cast<int>(points.size()), 0,
                   0);
  btVector3 inside(0, 0, 0);
  points.clear();
  for (int i = 0; i < computer.vertices.size(); ++i) points.push_back(computer.vertices[i]);
  for (const btVector3& point : points) inside += point / btScalar(points.size());
  std::vector<std::vector<int>> faces;
  for (int f = 0; f < computer.faces.size(); ++f) {
    const btConvexHullComputer::Edge* const first = &computer.edges[computer.faces[f]];
    const int apex = first->getSourceVertex();
    for (const auto* edge = first->getNextEdgeOfFace(); edge->getTargetVertex() != apex;
         edge = edge->getNextEdgeOfFace()) {
      std::vector<int> face{apex, edge->getSourceVertex(), edge->getTargetVertex()};
      const btVector3 out = (points[asIndex(face[1])] - points[asIndex(face[0])])
                                .cross(points[asIndex(face[2])] - points[asIndex(face[0])]);
      if (out.dot(points[asIndex(face[0])] - inside) < 0) std::swap(face[1], face[2]);
      faces.push_back(std::move(face));
    }
  }
  return faces;
}

struct AddPieces {
  std::vector<Piece>& pieces;

  void operator()(const Plane&) const {}
  void operator()(const Sphere& sphere) const {
    addRounded(sphere.centre, sphere.centre, sphere.radius, btVector3(0, 1, 0), pieces);
  }
  void operator()(const Capsule& capsule) const {
    addRounded(capsule.from, capsule.to, capsule.radius, (capsule.to - capsule.from).normalized(), pieces);
  }
  void operator()(const Cylinder& cylinder) const {
    const btVector3 axis = (cylinder.to - cylinder.from).normalized();
    const Round round(axis);
    const Normal out = [&](const btVector3& corner) {
      const btVector3 way = corner - cylinder.from;
      return (way - axis * way.dot(axis)).normalized();
    };
    round.addStrip(
        cylinder.from, 0, cylinder.from, cylinder.radius, [&](const btVector3&) { return -axis; }, pieces);
    round.addStrip(cylinder.from, cylinder.radius, cylinder.to, cylinder.radius, out, pieces);
    round.addStrip(
        cylinder.to, cylinder.radius, cylinder.to, 0, [&](const btVector3&) { return axis; }, pieces);
  }
  void operator()(const Box& box) const {
    constexpr int count = 8;  // small ones, so that cloth before and behind an edge sorts rightly
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {-1, 1}) {
        btVector3 out(0, 0, 0), u(0, 0, 0), v(0, 0, 0);
        out[axis] = btScalar(side);
        u[(axis + 1) % 3] = box.halfExtents[(axis + 1) % 3] * 2 / count;
        v[(axis + 2) % 3] = box.halfExtents[(axis + 2) % 3] * 2 / count;
        if (side < 0) std::swap(u, v);
        const btVector3 start = box.centre + out * box.halfExtents - (u + v) * (btScalar(count) / 2);
        for (int i = 0; i < count; ++i) {
          for (int j = 0; j < count; ++j) {
            const btVector3 corner = start + u * btScalar(i) + v * btScalar(j);
            pieces.push_back({{corner, corner + u, corner + u + v, corner + v}, {out, out, out, out}});
          }
        }
      }
    }
  }
  void operator()(const Hull& hull) const {
    std::vector<btVector3> points = hull.points;
    const std::vector<std::vector<int>> faces = facesOfHull(points);
    addFaces(points, faces, pieces);
  }
  void operator()(const TriangleMesh& mesh) const {
    std::vector<std::vector<int>> faces;
    for (const auto& corners : mesh.triangles) faces.emplace_back(corners.begin(), corners.end());
    addFaces(mesh.vertices, faces, pieces);
  }
};

}  // namespace

ColliderSurface surfaceOf(const Collider& collider) {
  ColliderSurface surface;
  std::visit(AddPieces{surface.pieces}, collider.shape);
  return surface;
}

double areaOf(const Collider& collider) {
  double area = 0;
  for (const ColliderSurface::Piece& piece : surfaceOf(collider).pieces) {
    for (std::size_t k = 2; k < piece.corners.size(); ++k) {
      const btVector3 u = piece.corners[k - 1] - piece.corners[0], v = piece.corners[k] - piece.corners[0];
      area += static_cast<double>(u.cross(v).length()) / 2;
    }
  }
  return area;
}

}  // namespace command
