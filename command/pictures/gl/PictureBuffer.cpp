// SPDX-License-Identifier: Zlib
#include "command/pictures/gl/PictureBuffer.h"

#include "Embedded.h"

namespace pictures {
namespace {

constexpr GLuint pictureUnit = 3;

}  // namespace

PictureBuffer::PictureBuffer()
    : m_smooth({embedded::common_glsl, embedded::smooth_vert_glsl},
               {embedded::common_glsl, embedded::smooth_frag_glsl}) {
  glGenFramebuffers(1, &m_framebuffer);
  glGenTextures(1, &m_colour);
  glGenRenderbuffers(1, &m_depth);
}

PictureBuffer::~PictureBuffer() {
  glDeleteFramebuffers(1, &m_framebuffer);
  glDeleteTextures(1, &m_colour);
  glDeleteRenderbuffers(1, &m_depth);
}

void PictureBuffer::resize(int width, int height) {
  m_width = width;
  m_height = height;
  glActiveTexture(GL_TEXTURE0 + pictureUnit);
  glBindTexture(GL_TEXTURE_2D, m_colour);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) {
    glTexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
  }
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T}) {
    glTexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
  }
  glBindRenderbuffer(GL_RENDERBUFFER, m_depth);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, width, height);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, m_colour, 0);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, m_depth);
}

void PictureBuffer::begin(int width, int height) {
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &m_framebufferBefore);
  glBindFramebuffer(GL_FRAMEBUFFER, m_framebuffer);
  if (width != m_width || height != m_height) resize(width, height);
  glViewport(0, 0, width, height);
}

void PictureBuffer::put(int x, int y, const Part& edges) {
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(m_framebufferBefore));
  glDisable(GL_SCISSOR_TEST);
  glBlitFramebuffer(0, 0, m_width, m_height, x, y, x + m_width, y + m_height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(m_framebufferBefore));
  glViewport(x, y, m_width, m_height);
  if (edges.width <= 0 || edges.height <= 0) return;
  glEnable(GL_SCISSOR_TEST);
  glScissor(x + edges.x, y + edges.y, edges.width, edges.height);
  glDisable(GL_DEPTH_TEST);
  m_smooth.use();
  m_smooth.set("picture", static_cast<int>(pictureUnit));
  m_smooth.set("origin", static_cast<float>(x), static_cast<float>(y));
  glActiveTexture(GL_TEXTURE0 + pictureUnit);
  glBindTexture(GL_TEXTURE_2D, m_colour);
  m_nothing.drawVertices(3);
  glDisable(GL_SCISSOR_TEST);
}

}  // namespace pictures
