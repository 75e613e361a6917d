// SPDX-License-Identifier: Zlib
#include "command/pictures/View.h"

#include "command/pictures/PosedSolid.h"
#include "command/pictures/VectorMath.h"

#include <algorithm>
#include <cmath>

namespace pictures {
namespace {

constexpr float freeBorder = 0.09F;  // of the picture's width and height, on each side

/// Lowest and highest of what was added.
struct Interval {
  float low = 1e30F;
  float high = -1e30F;

  void add(float value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  float middle() const { return 0.5F * (low + high); }
};

std::vector<Vector3> seenPoints(const Scenery& scenery, const std::vector<Frame>& frames) {
  std::vector<Vector3> points;
  for (const Frame& frame : frames) {
    for (const ClothState& cloth : frame.cloths) {
      points.insert(points.end(), cloth.positions.begin(), cloth.positions.end());
    }
    if (frame.poses.empty() && &frame != &frames.front()) continue;  // the solids are there already
    const std::vector<Vector3> solids = posedVertices(scenery, frame);
    points.insert(points.end(), solids.begin(), solids.end());
  }
  return points;
}

/// Right, up and forward, of length 1.
struct Axes {
  Vector3 right, up, forward;
};

Axes axesOf(const Scenery& scenery) {
  Axes axes;
  axes.forward = scenery.viewDirection * (1 / length(scenery.viewDirection));
  const Vector3 sideways = cross(axes.forward, scenery.up);
  const bool looksAlongUp = length(sideways) < 1e-3F;
  axes.right = looksAlongUp ? Vector3{1, 0, 0} : sideways * (1 / length(sideways));
  axes.up = cross(axes.right, axes.forward);
  return axes;
}

/// How far right of, above and in front of the origin.
Vector3 inAxes(const Axes& axes, const Vector3& point) {
  return {dot(axes.right, point), dot(axes.up, point), dot(axes.forward, point)};
}

}  // namespace

/// Each round centres the picture and then steps back until every point is inside; perspective makes the two depend
/// on each other, and a few rounds settle it.
View fitView(const Scenery& scenery, const std::vector<Frame>& frames, float aspect) {
  const Axes axes = axesOf(scenery);
  std::vector<Vector3> points = seenPoints(scenery, frames);
  if (points.empty()) points = {{-1, -1, -1}, {1, 1, 1}};
  for (Vector3& point : points) point = inAxes(axes, point);
  const float tangentY = (1 - 2 * freeBorder) * std::tan(scenery.fieldOfView * 3.14159265F / 360);
  const float tangentX = tangentY * aspect;
  Vector3 eye{0, 0, 0};
  Interval depth;
  for (const Vector3& point : points) depth.add(point[2]);
  eye[2] = depth.low - 1;
  for (int round = 0; round < 8; ++round) {
    Interval x, y;
    for (const Vector3& point : points) {
      x.add((point[0] - eye[0]) / (point[2] - eye[2]));
      y.add((point[1] - eye[1]) / (point[2] - eye[2]));
    }
    const float distance = depth.middle() - eye[2];
    eye[0] += x.middle() * distance;
    eye[1] += y.middle() * distance;
    eye[2] = 1e30F;
    for (const Vector3& point : points) {
      const float back =
          std::max({std::abs(point[0] - eye[0]) / tangentX, std::abs(point[1] - eye[1]) / tangentY, 1e-3F});
      eye[2] = std::min(eye[2], point[2] - back);
    }
  }
  const auto place = [&](const Vector3& p) { return axes.right * p[0] + axes.up * p[1] + axes.forward * p[2]; };
  return {place(eye), place({eye[0], eye[1], depth.middle()}), scenery.up, scenery.fieldOfView};
}

}  // namespace pictures
