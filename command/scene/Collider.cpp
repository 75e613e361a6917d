// SPDX-License-Identifier: Zlib
#include "command/scene/Collider.h"

#include <algorithm>

namespace command {
namespace {

/// Of the box round these points; `reach` goes from there to the farthest of them [m].
struct Middle {
  btVector3 place = btVector3(0, 0, 0);
  double reach = 0;
};

Middle middleOf(const std::vector<btVector3>& points, double around = 0) {
  btVector3 low = points.front();
  btVector3 high = low;
  for (const btVector3& point : points) {
    low.setMin(point);
    high.setMax(point);
  }
  Middle middle{(low + high) / 2, 0};
  for (const btVector3& point : points) {
    middle.reach = std::max(middle.reach, static_cast<double>((point - middle.place).length()) + around);
  }
  return middle;
}

struct FindMiddle {
  Middle operator()(const Plane& plane) const { return {plane.normal * btScalar(plane.offset), 0}; }
  Middle operator()(const Box& box) const { return {box.centre, static_cast<double>(box.halfExtents.length())}; }
  Middle operator()(const Sphere& sphere) const { return {sphere.centre, sphere.radius}; }
  Middle operator()(const Capsule& capsule) const { return middleOf({capsule.from, capsule.to}, capsule.radius); }
  Middle operator()(const Cylinder& cylinder) const { return middleOf({cylinder.from, cylinder.to}, cylinder.radius); }
  Middle operator()(const Hull& hull) const { return middleOf(hull.points); }
  Middle operator()(const TriangleMesh& mesh) const { return middleOf(mesh.vertices); }
};

}  // namespace

btVector3 middleOf(const Collider& collider) { return std::visit(FindMiddle(), collider.shape).place; }

bool isSolid(const std::vector<btVector3>& points) {
  if (points.size() < 4) return false;
  const btVector3& first = points.front();
  btVector3 longest(0, 0, 0);
  for (const btVector3& point : points) {
    if ((point - first).length2() > longest.length2()) longest = point - first;
  }
  btVector3 across(0, 0, 0);
  for (const btVector3& point : points) {
    const btVector3 normal = longest.cross(point - first);
    if (normal.length2() > across.length2()) across = normal;
  }
  if (!(across.length2() > 0)) return false;
  btScalar height = 0;
  for (const btVector3& point : points) height = std::max(height, btFabs((point - first).dot(across.normalized())));
  return height > btScalar(1e-4) * longest.length();
}

double reachOf(const Collider& collider) {
  const Middle middle = std::visit(FindMiddle(), collider.shape);
  if (!collider.motion) return static_cast<double>(middle.place.length()) + middle.reach;
  double farthest = 0;
  for (const btVector3& place : collider.motion->places) {
    farthest = std::max(farthest, static_cast<double>(place.length()));
  }
  return farthest + static_cast<double>((middle.place - collider.motion->pivot).length()) + middle.reach;
}

double fastestOf(const Collider& collider) {
  if (!collider.motion) return 0;
  const Middle middle = std::visit(FindMiddle(), collider.shape);
  return collider.motion->fastest(static_cast<double>((middle.place - collider.motion->pivot).length()) + middle.reach);
}

}  // namespace command
