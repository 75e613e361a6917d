// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/BodyPose.h"
#include "bullet_wetcloth/solver/ConvexHulls.h"

#include <BulletCollision/CollisionShapes/btCollisionShape.h>

#include <array>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// The surface of a collision shape near some boxes, as triangles in the frame of its body.
class ShapeFaces {
 public:
  struct Face {
    int corner[3];
    bool isEdge[3];  ///< whether the side from this corner to the next is one of the shape's; else it lies in a face
  };
  /// A part that is closed and convex.
  struct Hull {
    const ConvexHull* hull;
    BodyPose pose;  ///< in the body's frame
  };

  /// Convex shapes, triangle meshes, planes, and compounds of these; of others there is nothing.
  /// @param near    boxes in the body's frame: what meets none of them may be left out
  /// @param around  holds them all; what reaches far beyond it is cut there
  void find(const btCollisionShape& shape, const std::vector<BodyBox>& near, const BodyBox& around, ConvexHulls& hulls);
  /// Halves faces until no side is longer than that [m]. A plane beside a face keeps what is near it from all of the
  /// face, and where the body turns, from where far corners go.
  void refine(double longest);

  const std::vector<BodyPoint>& corners() const { return m_corners; }
  const std::vector<Face>& faces() const { return m_faces; }
  const std::vector<Hull>& hulls() const { return m_hulls; }

 private:
  struct Polygon {
    std::vector<BodyPoint> corners;
    std::vector<char> isEdge;
  };
  class TriangleReader;

  void add(const btCollisionShape& shape, const btTransform& pose, ConvexHulls& hulls);
  void addHull(const ConvexHull& hull, const BodyPose& pose);
  void addMesh(const btCollisionShape& shape, const BodyPose& pose);
  void addPlane(const btCollisionShape& shape, const BodyPose& pose);
  void weld(const std::vector<BodyPoint>& points);
  void halve(std::size_t face, std::size_t side);
  void weldMesh();
  void addMeshFaces();
  bool isNear(const BodyBox& box) const;
  bool reachesFar(const BodyBox& box) const;
  void addCut();
  void cut(std::size_t axis, double limit, bool isHigh);

  std::vector<BodyBox> m_near;
  BodyBox m_around;
  double m_far = 0;  // beyond the box around [m]
  std::vector<BodyPoint> m_corners;
  std::vector<Face> m_faces;
  std::vector<Hull> m_hulls;
  std::vector<int> m_numbers;     // of a hull's corners here; -1: not here yet
  std::vector<BodyPoint> m_soup;  // three for each triangle of a mesh
  std::vector<int> m_order;       // of points by place
  std::vector<int> m_welded;      // the first at each one's place
  std::vector<std::array<int, 3>> m_triangles;
  Polygon m_polygon;
  Polygon m_cutPolygon;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
