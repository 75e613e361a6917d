// SPDX-License-Identifier: Zlib
#pragma once

#include "command/viewer/LiveScene.h"

#include "command/pictures/Colouring.h"

#include <string>

namespace viewer {

/// What of the window is set, beside what is set of the scene.
struct ViewSettings {
  pictures::Colouring colouring = pictures::Colouring::fabric;
  bool slowMotion = false;
  bool panelShown = true;
  std::string message;  ///< the last thing that the window has to tell; empty: nothing
};

inline constexpr double slowMotionScale = 0.1;  ///< simulated time over the clock's

/// The widgets at the window's right side: what runs, which effects, what they take, levers and plots.
class Panel {
 public:
  /// In the window's units, for text of usual size.
  static constexpr float usualWidth = 345;

  /// @param left of the panel in the window; @param height of the window; @param width of the panel
  void draw(LiveScene& live, ViewSettings& settings, float left, float width, float height);
  /// Takes the time of a picture, for the plot [s].
  void noteFrame(double seconds);
  double framesPerSecond() const;

 private:
  void drawTime(LiveScene& live, ViewSettings& settings);
  void drawColourings(ViewSettings& settings);
  void drawEffects(LiveScene& live);
  void drawEffect(LiveScene& live, std::size_t index);
  void drawCosts(const LiveScene& live);
  void drawLevers(LiveScene& live);
  void drawWeather(LiveScene& live);
  bool drawWind(LiveScene& live);  // whether it moved, as the next two
  bool drawExposure(LiveScene& live);
  bool drawRain(LiveScene& live);
  void drawSolver(LiveScene& live);
  void drawFabric(LiveScene& live);
  void drawQuality(LiveScene& live);
  void drawPlots(const LiveScene& live);

  History m_frameTimes{240};  // [ms]
  std::string m_refusal;      // by a lever
};

}  // namespace viewer
