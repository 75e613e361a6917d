// SPDX-License-Identifier: Zlib
#pragma once

#include "command/viewer/LiveScene.h"

#include "command/pictures/gl/Renderer.h"

#include <array>

namespace viewer {

/// Which part of the window shows what. All but areaOf() in the window's own units, from the upper left.
struct ViewLayout {
  double width = 0;
  double height = 0;
  double panelWidth = 0;  ///< at the right side; 0: hidden
  double pixelsPerUnit = 1;
  bool isCompared = false;  ///< plain Bullet left, the wet cloth right of it

  double sceneWidth() const { return width - panelWidth; }
  double sideWidth() const { return isCompared ? sceneWidth() / 2 : sceneWidth(); }
  double leftOf(Side side) const { return isCompared && side == Side::wet ? sideWidth() : 0; }
  /// Width over height of one side's picture.
  double aspect() const { return sideWidth() / height; }

  Side sideAt(double x) const { return isCompared && x < sideWidth() ? Side::plainBullet : Side::wet; }
  /// As OrbitCamera has it: from the centre of the side's picture to its right and upper edge, [-1, 1].
  std::array<double, 2> inPicture(double x, double y, Side side) const {
    return {2 * (x - leftOf(side)) / sideWidth() - 1, 1 - 2 * y / height};
  }
  std::array<double, 2> inWindow(const std::array<double, 2>& place, Side side) const {
    return {leftOf(side) + (place[0] + 1) / 2 * sideWidth(), (1 - place[1]) / 2 * height};
  }

  /// Of the framebuffer.
  pictures::Renderer::Area areaOf(Side side) const {
    const int left = static_cast<int>(leftOf(side) * pixelsPerUnit);
    const int right = static_cast<int>((leftOf(side) + sideWidth()) * pixelsPerUnit);
    return {left, 0, right - left, static_cast<int>(height * pixelsPerUnit)};
  }
};

}  // namespace viewer
