// SPDX-License-Identifier: Zlib
#include "command/run/FrameShot.h"

#include "command/run/Saturation.h"

namespace command {

FrameShot takeShot(const SceneWorld& world, double time) {
  FrameShot shot;
  shot.time = time;
  shot.meanSaturation = saturationOf(world).mean;
  for (const wetcloth::WetCloth* wet : world.cloths()) {
    FrameShot::Cloth cloth;
    for (int i = 0; i < wet->nodeCount(); ++i) {
      cloth.positions.push_back(wet->body().m_nodes[i].m_x);
      cloth.colours.push_back(wet->colour(i));
      cloth.roughnesses.push_back(wet->roughness(i));
    }
    shot.cloths.push_back(cloth);
  }
  return shot;
}

}  // namespace command
