// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/Camera.h"

#include "bullet_wetcloth/shading/Colour.h"

#include <string>
#include <vector>

namespace command {

/// Light of the pictures: a lamp above and beside the camera, and the sky.
struct Light {
  btVector3 towardsLamp;  ///< of length 1

  explicit Light(const Camera& camera);
  /// Colour of a matt or, with a low roughness, glossy surface, lit from both sides. Linear RGB.
  wetcloth::Colour shade(const wetcloth::Colour& surface, double roughness, btVector3 normal,
                         const btVector3& towardsEye) const;
};

/// "#rrggbb" (sRGB) of linear RGB.
std::string hexColour(const wetcloth::Colour& linear);

/// Polygons, collected in any order and written from the farthest to the nearest.
class Painting {
 public:
  explicit Painting(const Camera& camera) : m_camera(camera) {}

  /// @param bias moves the polygon away from the camera in the order of painting only [m]
  /// @param opacity 1 for what nothing shows through
  void add(const std::vector<btVector3>& corners, const wetcloth::Colour& colour, double bias = 0, double opacity = 1);
  std::string svg();

 private:
  struct Polygon {
    double depth;
    std::vector<PicturePoint> corners;
    std::string colour;
    double opacity;
  };

  static std::string strokeOf(const Polygon& polygon);

  const Camera& m_camera;
  std::vector<Polygon> m_polygons;
};

/// Corners as the data of an SVG path.
std::string pathData(const std::vector<PicturePoint>& corners);

}  // namespace command
