// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/SceneOptions.h"

#include <optional>
#include <string>
#include <vector>

namespace command {

struct RenderOptions : SceneOptions {
  std::string out;   ///< file; its suffix chooses what is made
  std::string size;  ///< WIDTHxHEIGHT [pixels]; empty: as fits what is made
  std::optional<double> framesPerSecond;
  double speed = 1;                   ///< simulated seconds per second of film
  std::vector<double> times;          ///< of a picture [s]; none: the end
  std::vector<double> view;           ///< direction that the camera looks along; none: as the scene says
  double orbit = 0;                   ///< turn of the camera about the upright [degrees]
  std::optional<double> fieldOfView;  ///< vertical [degrees]
  std::string colouring = "fabric";
  bool compare = false;  ///< plain Bullet, dry and wet side by side
  std::string json;
};

/// The words for RenderOptions::colouring.
std::vector<std::string> colouringNames();
/// What RenderOptions::out may end in.
std::vector<std::string> renderSuffixes();

/// `wetcloth render`. @param arguments of the program, for its sibling of the other precision
void renderScene(const RenderOptions& options, char** arguments);

}  // namespace command
