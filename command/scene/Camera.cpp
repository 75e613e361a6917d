// SPDX-License-Identifier: Zlib
#include "command/scene/Camera.h"

#include <algorithm>
#include <cmath>

namespace command {
namespace {

constexpr double marginAtEdges = 0.09;  // of the picture's width and height, on each side

struct Extent {
  double low = 1e30;
  double high = -1e30;
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  double middle() const { return 0.5 * (low + high); }
};

}  // namespace

Camera::Camera(const std::vector<btVector3>& points, const btVector3& direction, const btVector3& up,
               double fieldOfView)
    : m_forward(direction.normalized()) {
  const btVector3 sideways = m_forward.cross(up);
  const bool looksAlongUp = sideways.length() < btScalar(1e-3);
  m_right = looksAlongUp ? btVector3(1, 0, 0) : sideways.normalized();
  m_up = m_right.cross(m_forward).normalized();
  m_pixelsPerTangent = 0.5 * height / std::tan(0.5 * fieldOfView * SIMD_PI / 180);
  fit(points);
}

/// Each round centres the picture and then steps back until every point is inside; perspective makes the two depend
/// on each other, and a few rounds settle it.
void Camera::fit(const std::vector<btVector3>& points) {
  const double usable = 1 - 2 * marginAtEdges;
  const double tangentX = usable * 0.5 * width / m_pixelsPerTangent;
  const double tangentY = usable * 0.5 * height / m_pixelsPerTangent;
  double centreX = 0;
  double centreY = 0;
  double back = 0;
  for (int round = 0; round < 8; ++round) {
    Extent x, y, distance;
    for (const btVector3& point : points) {
      const double depth = static_cast<double>(m_forward.dot(point)) + back;
      const double scale = round == 0 ? 1 : depth;
      x.add((static_cast<double>(m_right.dot(point)) - centreX) / scale);
      y.add((static_cast<double>(m_up.dot(point)) - centreY) / scale);
      distance.add(depth);
    }
    const double scale = round == 0 ? 1 : 0.5 * (distance.low + distance.high);
    centreX += x.middle() * scale;
    centreY += y.middle() * scale;
    back = -1e30;
    for (const btVector3& point : points) {
      const double offX = std::abs(static_cast<double>(m_right.dot(point)) - centreX) / tangentX;
      const double offY = std::abs(static_cast<double>(m_up.dot(point)) - centreY) / tangentY;
      back = std::max(back, std::max({offX, offY, 1e-3}) - static_cast<double>(m_forward.dot(point)));
    }
  }
  m_eye = m_right * btScalar(centreX) + m_up * btScalar(centreY) - m_forward * btScalar(back);
}

PicturePoint Camera::project(const btVector3& point) const {
  const btVector3 offset = point - m_eye;
  const double depth = static_cast<double>(m_forward.dot(offset));
  const double scale = m_pixelsPerTangent / std::max(depth, 1e-6);
  return {0.5 * width + scale * static_cast<double>(m_right.dot(offset)),
          0.5 * height - scale * static_cast<double>(m_up.dot(offset)), depth};
}

}  // namespace command
