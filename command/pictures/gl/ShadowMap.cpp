// SPDX-License-Identifier: Zlib
#include "command/pictures/gl/ShadowMap.h"

#include "command/pictures/VectorMath.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pictures {

ShadowMap::ShadowMap() {
  glGenTextures(1, &m_texture);
  glBindTexture(GL_TEXTURE_2D, m_texture);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, texels, texels, 0, GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
  const float farthest[] = {1, 1, 1, 1};
  glTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, farthest);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &m_framebufferBefore);
  glGenFramebuffers(1, &m_framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, m_framebuffer);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, m_texture, 0);
  glDrawBuffer(GL_NONE);
  glReadBuffer(GL_NONE);
  glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(m_framebufferBefore));
}

ShadowMap::~ShadowMap() {
  glDeleteFramebuffers(1, &m_framebuffer);
  glDeleteTextures(1, &m_texture);
}

/// The map moves and grows in steps, lest the edges of shadows shimmer when it follows a cloth.
void ShadowMap::fit(const std::vector<Vector3>& points, const Vector3& towardsLamp) {
  m_towardsLamp = towardsLamp;
  m_right = perpendicular(towardsLamp);
  m_up = cross(towardsLamp, m_right);
  Vector3 low{1e30F, 1e30F, 1e30F};
  Vector3 high{-1e30F, -1e30F, -1e30F};
  for (const Vector3& point : points) {
    const Vector3 seen{dot(m_right, point), dot(m_up, point), dot(towardsLamp, point)};
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], seen[i]);
      high[i] = std::max(high[i], seen[i]);
    }
  }
  if (points.empty()) low = high = {0, 0, 0};
  m_low = low;
  m_high = high;
  const float needed = 1.1F * std::max({high[0] - low[0], high[1] - low[1], 1e-3F});
  m_width = std::exp2(std::ceil(4 * std::log2(needed)) / 4);
  const float step = m_width / 64;
  m_width += 2 * step;
  for (std::size_t i = 0; i < 2; ++i) {
    const float middle = step * std::round(0.5F * (low[i] + high[i]) / step);
    low[i] = middle - 0.5F * m_width;
    high[i] = middle + 0.5F * m_width;
  }
  low[2] -= 0.1F * m_width;
  high[2] += 0.1F * m_width;
  m_depth = high[2] - low[2];
  m_clipFromWorld = product(orthographic(low, high), lookFrom({0, 0, 0}, m_right, m_up, towardsLamp * -1));
}

std::optional<ShadowMap::Footprint> ShadowMap::footprintOn(const Ground& ground) const {
  const float facing = dot(ground.normal, m_towardsLamp);
  if (facing < 0.05F) return std::nullopt;
  const float margin = 0.05F * m_width;  // for the soft edge
  const auto alongRay = [&](const Vector3& point) { return m_towardsLamp * (dot(ground.normal, point) / facing); };
  const Vector3 middle = m_right * (0.5F * (m_low[0] + m_high[0])) + m_up * (0.5F * (m_low[1] + m_high[1]));
  const Vector3 halfU = m_right * (0.5F * (m_high[0] - m_low[0]) + margin);
  const Vector3 halfV = m_up * (0.5F * (m_high[1] - m_low[1]) + margin);
  return Footprint{middle - alongRay(middle) + m_towardsLamp * (ground.offset / facing), halfU - alongRay(halfU),
                   halfV - alongRay(halfV)};
}

void ShadowMap::begin() {
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &m_framebufferBefore);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, m_framebuffer);
  glViewport(0, 0, texels, texels);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_CULL_FACE);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(1.5F, 4);
  glClear(GL_DEPTH_BUFFER_BIT);
}

void ShadowMap::end() {
  glDisable(GL_POLYGON_OFFSET_FILL);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(m_framebufferBefore));
}

Matrix4 ShadowMap::mapFromWorld() const {
  const Matrix4 halved{0.5F, 0, 0, 0, 0, 0.5F, 0, 0, 0, 0, 0.5F, 0, 0.5F, 0.5F, 0.5F, 1};
  return product(halved, m_clipFromWorld);
}

void ShadowMap::bind(GLuint unit) const {
  glActiveTexture(GL_TEXTURE0 + unit);
  glBindTexture(GL_TEXTURE_2D, m_texture);
}

}  // namespace pictures
