// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/gl/ShaderProgram.h"
#include "command/pictures/gl/VertexArray.h"

#include <epoxy/gl.h>

#include <array>

namespace pictures {

/// Holds a picture while it is drawn, and smooths the steps of its edges when it is put where it belongs. In a software
/// renderer this takes a fraction of what several samples per pixel take.
class PictureBuffer {
 public:
  /// Part of a picture [pixels], from the lower left.
  struct Part {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
  };

  PictureBuffer();
  ~PictureBuffer();
  PictureBuffer(const PictureBuffer&) = delete;
  PictureBuffer& operator=(const PictureBuffer&) = delete;

  /// Draws go here, until put().
  void begin(int width, int height);
  /// Puts the picture into the framebuffer that was bound before.
  /// @param x, y  of the picture's lower left corner there
  /// @param edges  part of the picture with edges to be smoothed
  void put(int x, int y, const Part& edges);

 private:
  void resize(int width, int height);

  ShaderProgram m_smooth;
  VertexArray m_nothing;
  GLuint m_framebuffer = 0;
  GLuint m_colour = 0;
  GLuint m_depth = 0;
  GLint m_framebufferBefore = 0;
  int m_width = 0;
  int m_height = 0;
};

}  // namespace pictures
