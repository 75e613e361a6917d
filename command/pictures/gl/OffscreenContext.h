// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/Image.h"

#include <memory>
#include <string>

namespace pictures {

/// An OpenGL 3.3 core context without a window or a display, current from when it is made until it is destroyed, and
/// a framebuffer that is bound.
class OffscreenContext {
 public:
  /// Throws Unavailable when there is no EGL, or none that needs no display, or no OpenGL 3.3, and std::runtime_error
  /// when the size is more than OpenGL's own limit.
  OffscreenContext(int width, int height);
  ~OffscreenContext();
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

  /// What has been drawn.
  Image read();
  /// The name that OpenGL has for what draws.
  std::string rendererName() const;

 private:
  class Display;
  class Framebuffer;
  std::unique_ptr<Display> m_display;
  std::unique_ptr<Framebuffer> m_framebuffer;
};

}  // namespace pictures
