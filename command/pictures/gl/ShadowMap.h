// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/FrameSequence.h"
#include "command/pictures/Matrix4.h"

#include <epoxy/gl.h>

#include <optional>
#include <vector>

namespace pictures {

/// Depths that a lamp, infinitely far away, sees.
class ShadowMap {
 public:
  ShadowMap();
  ~ShadowMap();
  ShadowMap(const ShadowMap&) = delete;
  ShadowMap& operator=(const ShadowMap&) = delete;

  /// Chooses what the map shows: all the points, which cast shadows.
  void fit(const std::vector<Vector3>& points, const Vector3& towardsLamp);
  /// Draws go into the map, with clipFromWorld(), until end(), after which they go where they went before.
  void begin();
  void end();

  const Matrix4& clipFromWorld() const { return m_clipFromWorld; }
  /// To coordinates of the map, [0, 1].
  Matrix4 mapFromWorld() const;
  /// Where shadows can fall on a plane: a parallelogram, given by its middle and two sides' halves. None where the lamp
  /// grazes the plane or is behind it.
  struct Footprint {
    Vector3 middle{};
    Vector3 halfU{};
    Vector3 halfV{};
  };
  std::optional<Footprint> footprintOn(const Ground& ground) const;
  /// Width of what the map shows [m].
  float width() const { return m_width; }
  static constexpr int texels = 512;  ///< on each side
  /// By how much depth grows over a distance [m] away from the lamp.
  float depthStep(float distance) const { return 2 * distance / m_depth; }
  void bind(GLuint unit) const;

 private:
  GLuint m_texture = 0;
  GLuint m_framebuffer = 0;
  GLint m_framebufferBefore = 0;
  Matrix4 m_clipFromWorld{};
  Vector3 m_right{};
  Vector3 m_up{};
  Vector3 m_towardsLamp{};
  Vector3 m_low{};  // of what casts shadows, along these three [m]
  Vector3 m_high{};
  float m_width = 1;
  float m_depth = 1;  // [m]
};

}  // namespace pictures
