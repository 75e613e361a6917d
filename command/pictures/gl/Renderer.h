// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/Colouring.h"
#include "command/pictures/FrameSequence.h"
#include "command/pictures/View.h"

#include <memory>
#include <string>
#include <vector>

namespace pictures {

/// Draws scenes with OpenGL 3.3 core: cloth lit from both sides, wet parts darker, more saturated and glossier, with a
/// weave that shows stretch; colliders, water, drops; soft shadows on the ground.
///
/// A context must be current when it is made, used and destroyed; it is the window's or OffscreenContext's.
class Renderer {
 public:
  /// Part of the framebuffer [pixels], from the lower left.
  struct Area {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
  };

  /// Throws std::runtime_error saying what is missing when the context is older than OpenGL 3.3 core.
  Renderer(const Scenery& scenery, const std::vector<ClothShape>& cloths);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  void setColouring(Colouring colouring);
  Colouring colouring() const;
  /// Makes the colour bar reach to the values of a frame, before any is drawn; draw() does it for the frame it draws.
  void includeInColourBar(const Frame& frame);

  /// Draws into the current framebuffer; the area is cleared first.
  /// @param frame  of the same cloths
  void draw(const Frame& frame, const View& view, const Area& area);
  /// Writes a line at the foot of an area that has been drawn: one text on its left, one on its right.
  void write(const std::string& left, const std::string& right, const Area& area);
  /// Writes a line at the head of an area, in its middle.
  void writeHead(const std::string& text, const Area& area);

 private:
  class Parts;
  std::unique_ptr<Parts> m_parts;
};

}  // namespace pictures
