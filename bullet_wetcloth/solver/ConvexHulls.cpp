// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/ConvexHulls.h"

#include "bullet_wetcloth/bullet/Index.h"

#include <BulletCollision/CollisionShapes/btConeShape.h>
#include <BulletCollision/CollisionShapes/btCylinderShape.h>
#include <BulletCollision/CollisionShapes/btPolyhedralConvexShape.h>
#include <LinearMath/btConvexHullComputer.h>

#include <algorithm>
#include <cmath>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr int kStepsKept = 600;
constexpr int kRimCorners = 20;  // of a cylinder or cone: within 1.3 % of its radius

// Twelve corners of an icosahedron and the middles of its edges.
const std::vector<btVector3>& directions() {
  static const std::vector<btVector3> all = [] {
    const btScalar golden = btScalar((1 + std::sqrt(5.0)) / 2);
    std::vector<btVector3> result;
    for (int axis = 0; axis < 3; ++axis) {
      for (const btScalar one : {btScalar(-1), btScalar(1)}) {
        for (const btScalar long_ : {-golden, golden}) {
          btVector3 corner(0, 0, 0);
          corner[(axis + 1) % 3] = one;
          corner[(axis + 2) % 3] = long_;
          result.push_back(corner);
        }
      }
    }
    const std::size_t corners = result.size();
    for (std::size_t i = 0; i < corners; ++i) {
      for (std::size_t k = i + 1; k < corners; ++k) {
        if ((result[i] - result[k]).length2() < btScalar(4.5)) result.push_back(result[i] + result[k]);
      }
    }
    for (btVector3& direction : result) direction.normalize();
    return result;
  }();
  return all;
}

void addRim(int axis, btScalar height, btScalar radius0, btScalar radius1, std::vector<btVector3>& points) {
  for (int k = 0; k < kRimCorners; ++k) {
    const double angle = 2 * 3.14159265358979323846 * k / kRimCorners;
    btVector3 point(0, 0, 0);
    point[axis] = height;
    point[(axis + 1) % 3] = radius0 * btScalar(std::cos(angle));
    point[(axis + 2) % 3] = radius1 * btScalar(std::sin(angle));
    points.push_back(point);
  }
}

void pointsOfCylinder(const btCylinderShape& shape, std::vector<btVector3>& points) {
  const int axis = shape.getUpAxis();
  const btVector3 half = shape.getHalfExtentsWithMargin();
  for (const btScalar height : {-half[axis], half[axis]}) {
    addRim(axis, height, half[(axis + 1) % 3], half[(axis + 2) % 3], points);
  }
}

void pointsOfCone(const btConeShape& shape, std::vector<btVector3>& points) {
  const int axis = shape.getConeUpIndex();
  btVector3 tip(0, 0, 0);
  tip[axis] = shape.getHeight() / 2;
  points.push_back(tip);
  addRim(axis, -shape.getHeight() / 2, shape.getRadius(), shape.getRadius(), points);
}

void pointsOf(const btConvexShape& shape, std::vector<btVector3>& points) {
  points.clear();
  const int type = shape.getShapeType();
  if (type == CYLINDER_SHAPE_PROXYTYPE) return pointsOfCylinder(static_cast<const btCylinderShape&>(shape), points);
  if (type == CONE_SHAPE_PROXYTYPE) return pointsOfCone(static_cast<const btConeShape&>(shape), points);
  if (shape.isPolyhedral() && type != CUSTOM_POLYHEDRAL_SHAPE_TYPE) {
    const auto& polyhedron = static_cast<const btPolyhedralConvexShape&>(shape);
    points.resize(toSize(polyhedron.getNumVertices()));
    for (std::size_t k = 0; k < points.size(); ++k) polyhedron.getVertex(static_cast<int>(k), points[k]);
    if (!points.empty()) return;
  }
  const bool isRoundByMargin = type == SPHERE_SHAPE_PROXYTYPE || type == MULTI_SPHERE_SHAPE_PROXYTYPE;
  const auto add = [&](const btVector3& direction) {
    points.push_back(isRoundByMargin ? shape.localGetSupportingVertex(direction)
                                     : shape.localGetSupportingVertexWithoutMargin(direction));
  };
  if (type != CAPSULE_SHAPE_PROXYTYPE) {
    for (const btVector3& direction : directions()) add(direction);
    return;
  }
  // Both half spheres.
  for (const btVector3& direction : directions()) {
    const btVector3 axisEnd = shape.localGetSupportingVertexWithoutMargin(direction);
    const btVector3 out = direction * shape.getMargin();
    points.push_back(axisEnd + out);
    points.push_back(out - axisEnd);
  }
}

// Bullet's own comparison may look at the fourth number, too.
bool areSame(const std::vector<btVector3>& a, const std::vector<btVector3>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const btVector3& p, const btVector3& q) {
    return p.x() == q.x() && p.y() == q.y() && p.z() == q.z();
  });
}

// Of a polygon, by Newell: sums the areas of its shadows.
ConvexHull::Plane planeOf(const ConvexHull& hull, std::size_t polygon, const BodyPoint& inside) {
  ConvexHull::Plane plane = {{0, 0, 0}, 0};
  const std::size_t first = hull.first[polygon];
  const std::size_t count = hull.first[polygon + 1] - first;
  const auto corner = [&](std::size_t k) -> const BodyPoint& {
    return hull.corners[toSize(hull.cornerOfPolygon[first + k])];
  };
  for (std::size_t k = 0; k < count; ++k) {
    const BodyPoint& a = corner(k);
    const BodyPoint& b = corner(k + 1 < count ? k + 1 : 0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t u = (axis + 1) % 3;
      const std::size_t v = (axis + 2) % 3;
      plane.normal[axis] += (a[u] - inside[u]) * (b[v] - inside[v]) - (a[v] - inside[v]) * (b[u] - inside[u]);
    }
  }
  double length = std::sqrt(plane.normal[0] * plane.normal[0] + plane.normal[1] * plane.normal[1] +
                            plane.normal[2] * plane.normal[2]);
  if (!(length > 0)) length = 1;
  const auto along = [&](const BodyPoint& p) {
    return plane.normal[0] * p[0] + plane.normal[1] * p[1] + plane.normal[2] * p[2];
  };
  if (along(corner(0)) < along(inside)) length = -length;
  for (double& component : plane.normal) component /= length;
  plane.offset = along(corner(0));
  for (std::size_t k = 1; k < count; ++k) plane.offset = std::max(plane.offset, along(corner(k)));
  return plane;
}

void makeHull(const std::vector<btVector3>& points, ConvexHull& hull) {
  hull.points = points;
  BodyPoint middle = {0, 0, 0};
  for (const btVector3& point : points) {
    hull.corners.push_back(bodyPointOf(point));
    hull.box.include(hull.corners.back());
    for (std::size_t k = 0; k < 3; ++k) middle[k] += hull.corners.back()[k] / static_cast<double>(points.size());
  }
  btConvexHullComputer computer;
  computer.compute(hull.corners.front().data(), static_cast<int>(sizeof(BodyPoint)), static_cast<int>(points.size()), 0,
                   0);
  hull.first.push_back(0);
  for (int face = 0; face < computer.faces.size(); ++face) {
    const btConvexHullComputer::Edge* const begin = &computer.edges[computer.faces[face]];
    const btConvexHullComputer::Edge* edge = begin;
    do {
      hull.cornerOfPolygon.push_back(computer.original_vertex_index[edge->getSourceVertex()]);
      edge = edge->getNextEdgeOfFace();
    } while (edge != begin);
    hull.first.push_back(hull.cornerOfPolygon.size());
    hull.planes.push_back(planeOf(hull, hull.planes.size(), middle));
    hull.sides.add(hull.planes.back().normal, hull.planes.back().offset);
  }
}

}  // namespace

const ConvexHull& ConvexHulls::of(const btConvexShape& shape) {
  pointsOf(shape, m_points);
  for (const auto& kept : m_kept) {
    if (!areSame(kept->hull.points, m_points)) continue;
    kept->age = 0;
    return kept->hull;
  }
  m_kept.push_back(std::make_unique<Kept>());
  if (!m_points.empty()) makeHull(m_points, m_kept.back()->hull);
  return m_kept.back()->hull;
}

void ConvexHulls::endStep() {
  const auto isOld = [](const std::unique_ptr<Kept>& kept) { return ++kept->age > kStepsKept; };
  m_kept.erase(std::remove_if(m_kept.begin(), m_kept.end(), isOld), m_kept.end());
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
