#pragma once

#include "../Matrix4.h"
#include "../Recording.h"

#include <epoxy/gl.h>

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
  /// Width of what the map shows [m].
  float width() const { return m_width; }
  static constexpr int texels = 1024;  ///< on each side
  void bind(GLuint unit) const;

 private:
  GLuint m_texture = 0;
  GLuint m_framebuffer = 0;
  GLint m_framebufferBefore = 0;
  Matrix4 m_clipFromWorld{};
  float m_width = 1;
};

}  // namespace pictures
