// SPDX-License-Identifier: Zlib
#include "command/viewer/OrbitCamera.h"

#include "command/viewer/PlainVector.h"

#include <algorithm>
#include <cmath>

namespace viewer {
namespace {

constexpr double steepest = 1.55;  // [rad], less than a right angle
constexpr double nearest = 0.02;   // [m]
constexpr double farthest = 500;   // [m]

/// Any direction across `up`.
btVector3 across(const btVector3& up) {
  const btVector3 other = std::abs(up.x()) < btScalar(0.9) ? btVector3(1, 0, 0) : btVector3(0, 0, 1);
  return up.cross(other).normalized();
}

}  // namespace

OrbitCamera::OrbitCamera(const pictures::View& view)
    : m_up(bulletVector(view.up).normalized()),
      m_east(across(m_up)),
      m_north(m_up.cross(m_east)),
      m_target(bulletVector(view.target)),
      m_fieldOfView(static_cast<double>(view.fieldOfView) * SIMD_RADS_PER_DEG) {
  const btVector3 away = bulletVector(view.eye) - m_target;
  m_distance = std::clamp(static_cast<double>(away.length()), nearest, farthest);
  m_heading = std::atan2(static_cast<double>(away.dot(m_east)), static_cast<double>(away.dot(m_north)));
  const double sine = static_cast<double>(away.dot(m_up)) / m_distance;
  m_height = std::clamp(std::asin(std::clamp(sine, -1.0, 1.0)), -steepest, steepest);
}

void OrbitCamera::stayAbove(double height) {
  m_floor = height;
  leaveFloor();
}

void OrbitCamera::leaveFloor() {
  if (!m_floor) return;
  const double sine = (*m_floor + nearest - static_cast<double>(m_target.dot(m_up))) / m_distance;
  if (sine < 0) m_height = std::max(m_height, std::asin(std::max(sine, -1.0)));
}

void OrbitCamera::orbit(double eastwards, double upwards) {
  m_heading += eastwards;
  m_height = std::clamp(m_height + upwards, -steepest, steepest);
  leaveFloor();
}

void OrbitCamera::pan(double rightwards, double upwards) {
  const double height = 2 * halfHeight() * m_distance;
  const Axes at = axes();
  m_target += at.right * btScalar(rightwards * height) + at.up * btScalar(upwards * height);
  leaveFloor();
}

void OrbitCamera::zoom(double factor) {
  m_distance = std::clamp(m_distance * factor, nearest, farthest);
  leaveFloor();
}

OrbitCamera::Axes OrbitCamera::axes() const {
  const btVector3 level = m_north * btScalar(std::cos(m_heading)) + m_east * btScalar(std::sin(m_heading));
  Axes axes;
  axes.forward = -(level * btScalar(std::cos(m_height)) + m_up * btScalar(std::sin(m_height)));
  axes.right = axes.forward.cross(m_up).normalized();
  axes.up = axes.right.cross(axes.forward);
  return axes;
}

btVector3 OrbitCamera::eye() const { return m_target - axes().forward * btScalar(m_distance); }

double OrbitCamera::halfHeight() const { return std::tan(m_fieldOfView / 2); }

pictures::View OrbitCamera::view() const {
  return {plainVector(eye()), plainVector(m_target), plainVector(m_up),
          static_cast<float>(m_fieldOfView / SIMD_RADS_PER_DEG)};
}

Ray OrbitCamera::rayThrough(double x, double y, double aspect) const {
  const Axes at = axes();
  const btVector3 direction =
      at.forward + at.right * btScalar(x * aspect * halfHeight()) + at.up * btScalar(y * halfHeight());
  return {eye(), direction.normalized()};
}

std::optional<std::array<double, 2>> OrbitCamera::project(const btVector3& point, double aspect) const {
  const Axes at = axes();
  const btVector3 from = point - eye();
  const double depth = static_cast<double>(from.dot(at.forward));
  if (!(depth > 0)) return std::nullopt;
  return std::array<double, 2>{static_cast<double>(from.dot(at.right)) / (depth * aspect * halfHeight()),
                               static_cast<double>(from.dot(at.up)) / (depth * halfHeight())};
}

btScalar OrbitCamera::depthOf(const btVector3& point) const { return (point - eye()).dot(axes().forward); }

}  // namespace viewer
