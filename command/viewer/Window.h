// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/Image.h"

#include <memory>
#include <string>
#include <vector>

namespace viewer {

/// A window with an OpenGL 3.3 core context, in which Dear ImGui draws its widgets.
class Window {
 public:
  /// Throws RunError when there is no display or no OpenGL 3.3.
  Window(const std::string& title, int width, int height);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  bool isClosed() const;
  void close();
  /// Of the framebuffer [pixels].
  int width() const;
  int height() const;
  /// Pixels of the framebuffer for each of the window's own units, those of the mouse and of the widgets.
  double pixelsPerUnit() const;
  /// How much larger than usual text is to be on this display.
  double textScale() const;
  /// Since the program began [s].
  double time() const;

  /// Takes what happened since the last picture, and begins the next one; where nothing has, waits for it so long [s].
  void beginPicture(double patience);
  /// Names of the keys that were pressed since the last picture, "a" and so on as they are labelled, "1", "space",
  /// "escape"; not those meant for a widget.
  const std::vector<std::string>& keys() const;
  /// Draws the widgets over the picture.
  void drawWidgets();
  /// What has been drawn.
  pictures::Image read() const;
  /// Shows the picture.
  void show();

 private:
  class Parts;
  std::unique_ptr<Parts> m_parts;
};

}  // namespace viewer
