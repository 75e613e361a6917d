// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/gl/ShaderProgram.h"
#include "command/pictures/gl/VertexArray.h"

#include "command/pictures/FrameSequence.h"

#include <array>
#include <string>
#include <vector>

namespace pictures {

/// Flat rectangles and text on top of a picture, in pixels from its upper left.
class Overlay {
 public:
  Overlay();
  ~Overlay();
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;

  /// sRGB and cover.
  using Tint = std::array<float, 4>;

  /// Height of a line of the text that follows [pixels].
  void setTextSize(float pixels);
  float textSize() const { return m_textSize; }
  float widthOf(const std::string& text) const;
  void addRectangle(float left, float top, float width, float height, const Tint& tint);
  /// @param left, baseline  where the text begins
  void addText(float left, float baseline, const std::string& text, const Tint& tint);
  /// Draws what was added, and forgets it.
  void draw(float areaWidth, float areaHeight);

 private:
  struct Glyph {
    float left, top, right, bottom;  // from the pen [pixels]
    float u0, v0, u1, v1;            // in the atlas
    float advance;                   // [pixels]
  };

  void bake(int pixels);
  const Glyph& glyphOf(char character) const;
  void addQuadrilateral(const std::array<float, 4>& place, const std::array<float, 4>& inAtlas, const Tint& tint);

  ShaderProgram m_program;
  VertexArray m_vertices;
  GLuint m_atlas = 0;
  int m_baked = 0;  // size of the glyphs in the atlas [pixels]
  float m_textSize = 16;
  std::vector<Glyph> m_glyphs;
  std::vector<float> m_corners;
};

}  // namespace pictures
