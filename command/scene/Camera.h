// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btVector3.h>

#include <vector>

namespace command {

struct PicturePoint {
  double x = 0;      ///< pixels, to the right
  double y = 0;      ///< pixels, downwards
  double depth = 0;  ///< distance from the camera along its view [m]
};

/// A pinhole camera.
class Camera {
 public:
  static constexpr double width = 960;  ///< of the picture [pixels]
  static constexpr double height = 720;

  /// Looks along `direction`, as near as all the points are in the picture.
  /// @param fieldOfView vertical [degrees]
  Camera(const std::vector<btVector3>& points, const btVector3& direction, const btVector3& up, double fieldOfView);

  PicturePoint project(const btVector3& point) const;
  /// Of length 1, from the point to the camera.
  btVector3 towards(const btVector3& point) const { return (m_eye - point).normalized(); }
  const btVector3& eye() const { return m_eye; }
  const btVector3& right() const { return m_right; }
  const btVector3& up() const { return m_up; }
  const btVector3& forward() const { return m_forward; }

 private:
  void fit(const std::vector<btVector3>& points);

  btVector3 m_right;
  btVector3 m_up;
  btVector3 m_forward;
  btVector3 m_eye = btVector3(0, 0, 0);
  double m_pixelsPerTangent;
};

}  // namespace command
