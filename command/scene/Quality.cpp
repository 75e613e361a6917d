// SPDX-License-Identifier: Zlib
#include "command/scene/Quality.h"

namespace command {

std::string qualityOf(const Scene& scene) { return scene.quality.empty() ? "scene" : scene.quality; }

const NamedValues<Quality>& qualityNames() {
  static const NamedValues<Quality> names{{"draft", Quality::draft},
                                          {"realtime", Quality::realtime},
                                          {"accurate", Quality::accurate},
                                          {"reference", Quality::reference}};
  return names;
}

double allowedError(Quality quality) {
  switch (quality) {
    case Quality::draft: return 0.10;
    case Quality::realtime: return 0.03;
    case Quality::accurate: return 0.01;
    case Quality::reference: break;
  }
  return 0;
}

}  // namespace command
