// SPDX-License-Identifier: Zlib
#pragma once

#include "command/viewer/Picking.h"

#include "command/pictures/View.h"

#include <array>
#include <optional>

namespace viewer {

/// A camera that goes round a point, always upright.
class OrbitCamera {
 public:
  explicit OrbitCamera(const pictures::View& view);

  /// The eye stays above it, unless the target is below. @param height of the floor along the view's up [m]
  void stayAbove(double height);

  /// Round the target [rad]: eastwards, and higher; never over the top.
  void orbit(double eastwards, double upwards);
  /// With the target, across the view [heights of the picture].
  void pan(double rightwards, double upwards);
  /// Away from the target: times so far, within what can be seen.
  void zoom(double factor);

  pictures::View view() const;
  /// Of a point of the picture. @param x, y from its centre to its right and upper edge, [-1, 1]
  /// @param aspect width over height of the picture
  Ray rayThrough(double x, double y, double aspect) const;
  /// Where in the picture a point is, x and y as above; none behind the camera.
  std::optional<std::array<double, 2>> project(const btVector3& point, double aspect) const;
  /// How far before the camera, along its view [m].
  btScalar depthOf(const btVector3& point) const;

 private:
  struct Axes {
    btVector3 right, up, forward;
  };
  Axes axes() const;
  btVector3 eye() const;
  void leaveFloor();
  double halfHeight() const;  // of the picture at depth 1

  btVector3 m_up;
  btVector3 m_east;  // m_east, m_up and m_north are perpendicular to each other and of length 1
  btVector3 m_north;
  btVector3 m_target;
  double m_distance;
  double m_heading = 0;  // of the eye seen from the target, from north to east [rad]
  double m_height = 0;   // of the eye above the horizon [rad]
  double m_fieldOfView;  // vertical [rad]
  std::optional<double> m_floor;
};

}  // namespace viewer
