// SPDX-License-Identifier: Zlib
#include "command/run/Saturation.h"

#include <algorithm>
#include <limits>

namespace command {

Saturation saturationOf(const SceneWorld& world) {
  if (world.cloths().empty()) return {};
  Saturation saturation{std::numeric_limits<double>::infinity(), 0, 0};
  double held = 0;
  double capacity = 0;
  for (const wetcloth::WetCloth* cloth : world.cloths()) {
    for (int i = 0; i < cloth->nodeCount(); ++i) {
      saturation.min = std::min(saturation.min, cloth->saturation(i));
      saturation.max = std::max(saturation.max, cloth->saturation(i));
      held += cloth->held(i);
      capacity += cloth->capacity(i);
    }
  }
  saturation.mean = held / capacity;
  return saturation;
}

}  // namespace command
