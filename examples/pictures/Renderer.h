#pragma once

#include "Recording.h"
#include "View.h"

#include <memory>
#include <vector>

namespace pictures {

/// What the colours of a cloth mean.
enum class Colouring { fabric, saturation, stretch, speed };

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

  /// Draws into the current framebuffer; the area is cleared first.
  /// @param frame  of the same cloths
  void draw(const Frame& frame, const View& view, const Area& area);

 private:
  class Parts;
  std::unique_ptr<Parts> m_parts;
};

}  // namespace pictures
