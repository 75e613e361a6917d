// SPDX-License-Identifier: Zlib
#include "command/viewer/Player.h"

#include "command/cli/Errors.h"

namespace viewer {

void requirePlayer() {
  throw command::InputError(
      "wetcloth: this program was built without the window of `wetcloth view`; install GLFW, Dear ImGui, epoxy and stb "
      "(Debian: apt install libglfw3-dev libimgui-dev libepoxy-dev libstb-dev) and build it again");
}

PlayerReport play(LiveScene&, const PlayerOptions&) {
  requirePlayer();
  return {};
}

}  // namespace viewer
