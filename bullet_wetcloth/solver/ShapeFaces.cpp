// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/ShapeFaces.h"

#include "bullet_wetcloth/bullet/Index.h"

#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/CollisionShapes/btConcaveShape.h>
#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>
#include <BulletCollision/CollisionShapes/btTriangleCallback.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

btVector3 bulletsOf(const BodyPoint& p) {
  return btVector3(static_cast<btScalar>(p[0]), static_cast<btScalar>(p[1]), static_cast<btScalar>(p[2]));
}

double lengthOf(const BodyBox& box) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += (box.high[k] - box.low[k]) * (box.high[k] - box.low[k]);
  return std::sqrt(sum);
}

}  // namespace

// Takes what Bullet finds in a mesh.
class ShapeFaces::TriangleReader final : public btTriangleCallback {
 public:
  TriangleReader(const BodyPose& pose, std::vector<BodyPoint>& soup) : m_pose(pose), m_soup(soup) {}
  void processTriangle(btVector3* triangle, int, int) override {
    for (int k = 0; k < 3; ++k) m_soup.push_back(m_pose.outOf(bodyPointOf(triangle[k])));
  }

 private:
  const BodyPose& m_pose;
  std::vector<BodyPoint>& m_soup;
};

void ShapeFaces::find(const btCollisionShape& shape, const std::vector<BodyBox>& near, const BodyBox& around,
                      ConvexHulls& hulls) {
  m_corners.clear();
  m_faces.clear();
  m_hulls.clear();
  m_near = near;
  m_around = around;
  m_far = lengthOf(around);
  add(shape, btTransform::getIdentity(), hulls);
}

bool ShapeFaces::isNear(const BodyBox& box) const {
  return std::any_of(m_near.begin(), m_near.end(), [&](const BodyBox& near) { return near.overlaps(box); });
}

bool ShapeFaces::reachesFar(const BodyBox& box) const {
  BodyBox far = m_around;
  far.grow(m_far);
  return !far.contains(box);
}

void ShapeFaces::add(const btCollisionShape& shape, const btTransform& pose, ConvexHulls& hulls) {
  btVector3 low;
  btVector3 high;
  shape.getAabb(pose, low, high);
  BodyBox box;
  box.include(bodyPointOf(low));
  box.include(bodyPointOf(high));
  if (!isNear(box)) return;
  const BodyPose exact(pose, {0, 0, 0});
  if (shape.isCompound()) {
    const auto& compound = static_cast<const btCompoundShape&>(shape);
    for (int k = 0; k < compound.getNumChildShapes(); ++k) {
      add(*compound.getChildShape(k), pose * compound.getChildTransform(k), hulls);
    }
  } else if (shape.isConvex()) {
    addHull(hulls.of(static_cast<const btConvexShape&>(shape)), exact);
  } else if (shape.getShapeType() == STATIC_PLANE_PROXYTYPE) {
    addPlane(shape, exact);
  } else if (shape.isConcave()) {
    addMesh(shape, exact);
  }
}

// --- convex ---------------------------------------------------------------------------------------------------------

void ShapeFaces::addHull(const ConvexHull& hull, const BodyPose& pose) {
  m_hulls.push_back({&hull, pose});
  m_numbers.assign(hull.corners.size(), -1);
  for (std::size_t k = 0; k < hull.polygons(); ++k) {
    m_polygon.corners.clear();
    BodyBox box;
    for (std::size_t i = hull.first[k]; i < hull.first[k + 1]; ++i) {
      m_polygon.corners.push_back(pose.outOf(hull.corners[toSize(hull.cornerOfPolygon[i])]));
      box.include(m_polygon.corners.back());
    }
    if (!isNear(box)) continue;
    const std::size_t count = m_polygon.corners.size();
    if (reachesFar(box)) {
      m_polygon.isEdge.assign(count, 1);
      addCut();
      continue;
    }
    const auto number = [&](std::size_t i) {
      int& known = m_numbers[toSize(hull.cornerOfPolygon[hull.first[k] + i])];
      if (known < 0) {
        known = static_cast<int>(m_corners.size());
        m_corners.push_back(m_polygon.corners[i]);
      }
      return known;
    };
    for (std::size_t i = 1; i + 1 < count; ++i) {
      m_faces.push_back({{number(0), number(i), number(i + 1)}, {i == 1, true, i + 2 == count}});
    }
  }
}

// A square that covers the box around.
void ShapeFaces::addPlane(const btCollisionShape& shape, const BodyPose& pose) {
  const auto& plane = static_cast<const btStaticPlaneShape&>(shape);
  BodyPoint normal = bodyPointOf(plane.getPlaneNormal());
  BodyPoint onPlane = normal;
  for (double& x : onPlane) x *= static_cast<double>(plane.getPlaneConstant());
  onPlane = pose.outOf(onPlane);
  const BodyPoint zero = pose.outOf({0, 0, 0});
  normal = pose.outOf(normal);
  BodyPoint middle;
  double above = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    normal[k] -= zero[k];
    middle[k] = (m_around.low[k] + m_around.high[k]) / 2;
    above += normal[k] * (middle[k] - onPlane[k]);
  }
  const btVector3 along = bulletsOf(normal);
  btVector3 u;
  btVector3 v;
  btPlaneSpace1(along, u, v);
  const int first = static_cast<int>(m_corners.size());
  for (const auto& sign : {std::array<double, 2>{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    BodyPoint corner;
    for (std::size_t k = 0; k < 3; ++k) {
      const int axis = static_cast<int>(k);
      corner[k] = middle[k] - above * normal[k] +
                  m_far * (sign[0] * static_cast<double>(u[axis]) + sign[1] * static_cast<double>(v[axis]));
    }
    m_corners.push_back(corner);
  }
  m_faces.push_back({{first, first + 1, first + 2}, {false, false, false}});
  m_faces.push_back({{first, first + 2, first + 3}, {false, false, false}});
}

// --- meshes ---------------------------------------------------------------------------------------------------------

void ShapeFaces::addMesh(const btCollisionShape& shape, const BodyPose& pose) {
  m_soup.clear();
  TriangleReader reader(pose, m_soup);
  for (const BodyBox& near : m_near) {
    const BodyBox box = boxInto(pose, near);
    static_cast<const btConcaveShape&>(shape).processAllTriangles(&reader, bulletsOf(box.low), bulletsOf(box.high));
  }
  weldMesh();
  addMeshFaces();
}

// Of each point: the first at the same place.
void ShapeFaces::weld(const std::vector<BodyPoint>& points) {
  m_order.resize(points.size());
  std::iota(m_order.begin(), m_order.end(), 0);
  std::sort(m_order.begin(), m_order.end(), [&](int a, int b) {
    return points[toSize(a)] != points[toSize(b)] ? points[toSize(a)] < points[toSize(b)] : a < b;
  });
  m_welded.resize(points.size());
  for (std::size_t k = 0; k < m_order.size(); ++k) {
    const bool isNew = k == 0 || points[toSize(m_order[k])] != points[toSize(m_order[k - 1])];
    m_welded[toSize(m_order[k])] = isNew ? m_order[k] : m_welded[toSize(m_order[k - 1])];
  }
}

// Corners at one place are one corner, and what several boxes have found is there once.
void ShapeFaces::weldMesh() {
  weld(m_soup);
  m_triangles.clear();
  for (std::size_t k = 0; k + 2 < m_soup.size(); k += 3) {
    const std::array<int, 3> triangle = {m_welded[k], m_welded[k + 1], m_welded[k + 2]};
    const bool isOne = triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0];
    if (isOne) m_triangles.push_back(triangle);
  }
  if (m_near.size() < 2) return;
  std::sort(m_triangles.begin(), m_triangles.end());
  m_triangles.erase(std::unique(m_triangles.begin(), m_triangles.end()), m_triangles.end());
}

void ShapeFaces::addMeshFaces() {
  m_numbers.assign(m_soup.size(), -1);
  for (const std::array<int, 3>& triangle : m_triangles) {
    BodyBox box;
    for (const int corner : triangle) box.include(m_soup[toSize(corner)]);
    if (!isNear(box)) continue;
    if (reachesFar(box)) {
      m_polygon.corners.clear();
      for (const int corner : triangle) m_polygon.corners.push_back(m_soup[toSize(corner)]);
      m_polygon.isEdge.assign(3, 1);
      addCut();
      continue;
    }
    Face face = {{0, 0, 0}, {true, true, true}};
    for (std::size_t k = 0; k < 3; ++k) {
      int& known = m_numbers[toSize(triangle[k])];
      if (known < 0) {
        known = static_cast<int>(m_corners.size());
        m_corners.push_back(m_soup[toSize(triangle[k])]);
      }
      face.corner[k] = known;
    }
    m_faces.push_back(face);
  }
}

// --- what is too large -----------------------------------------------------------------------------------------------

void ShapeFaces::refine(double longest) {
  const std::size_t corners = m_corners.size();
  for (std::size_t face = 0; face < m_faces.size();) {
    std::size_t side = 0;
    double length = 0;
    BodyBox box;
    for (std::size_t k = 0; k < 3; ++k) {
      const BodyPoint& a = m_corners[toSize(m_faces[face].corner[k])];
      BodyBox of;
      of.include(a);
      of.include(m_corners[toSize(m_faces[face].corner[(k + 1) % 3])]);
      box.include(of);
      if (lengthOf(of) <= length) continue;
      length = lengthOf(of);
      side = k;
    }
    if (!(length > longest)) {
      ++face;
    } else if (isNear(box)) {
      halve(face, side);
    } else {
      m_faces[face] = m_faces.back();
      m_faces.pop_back();
    }
  }
  if (m_corners.size() == corners) return;
  weld(m_corners);
  for (Face& face : m_faces) {
    for (int& corner : face.corner) corner = m_welded[toSize(corner)];
  }
}

void ShapeFaces::halve(std::size_t face, std::size_t side) {
  const Face whole = m_faces[face];
  const std::size_t next = (side + 1) % 3;
  const std::size_t last = (side + 2) % 3;
  const BodyPoint& a = m_corners[toSize(whole.corner[side])];
  const BodyPoint& b = m_corners[toSize(whole.corner[next])];
  const int middle = static_cast<int>(m_corners.size());
  m_corners.push_back({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2});
  m_faces[face] = {{whole.corner[side], middle, whole.corner[last]}, {whole.isEdge[side], false, whole.isEdge[last]}};
  m_faces.push_back(
      {{middle, whole.corner[next], whole.corner[last]}, {whole.isEdge[side], whole.isEdge[next], false}});
}

// --- what reaches far -----------------------------------------------------------------------------------------------

// Sutherland and Hodgman, Reentrant polygon clipping, 1974.
void ShapeFaces::cut(std::size_t axis, double limit, bool isHigh) {
  m_cutPolygon.corners.clear();
  m_cutPolygon.isEdge.clear();
  const std::size_t count = m_polygon.corners.size();
  const auto inside = [&](std::size_t k) {
    const double x = m_polygon.corners[k][axis];
    return isHigh ? limit - x : x - limit;
  };
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t next = (k + 1) % count;
    const double here = inside(k);
    const double there = inside(next);
    if (here >= 0) {
      m_cutPolygon.corners.push_back(m_polygon.corners[k]);
      m_cutPolygon.isEdge.push_back(m_polygon.isEdge[k]);
    }
    if ((here >= 0) == (there >= 0)) continue;
    BodyPoint crossing;
    const double share = here / (here - there);
    for (std::size_t i = 0; i < 3; ++i) {
      crossing[i] = m_polygon.corners[k][i] + share * (m_polygon.corners[next][i] - m_polygon.corners[k][i]);
    }
    m_cutPolygon.corners.push_back(crossing);
    m_cutPolygon.isEdge.push_back(here >= 0 ? 0 : m_polygon.isEdge[k]);
  }
  std::swap(m_polygon, m_cutPolygon);
}

void ShapeFaces::addCut() {
  BodyBox limit = m_around;
  limit.grow(m_far / 2);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cut(axis, limit.low[axis], false);
    cut(axis, limit.high[axis], true);
  }
  const std::size_t count = m_polygon.corners.size();
  const int first = static_cast<int>(m_corners.size());
  m_corners.insert(m_corners.end(), m_polygon.corners.begin(), m_polygon.corners.end());
  for (std::size_t k = 1; k + 1 < count; ++k) {
    const int i = static_cast<int>(k);
    m_faces.push_back({{first, first + i, first + i + 1},
                       {k == 1 && m_polygon.isEdge[0] != 0, m_polygon.isEdge[k] != 0,
                        k + 2 == count && m_polygon.isEdge[count - 1] != 0}});
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
