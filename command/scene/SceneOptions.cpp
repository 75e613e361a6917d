// SPDX-License-Identifier: Zlib
#include "command/scene/SceneOptions.h"

#include "command/cli/Errors.h"
#include "command/cli/Sibling.h"
#include "command/scene/MeasuredFront.h"
#include "command/scene/Quality.h"
#include "command/scene/SceneReader.h"

#include <cstdio>

namespace command {
namespace {

void requireDuration(double duration) {
  if (duration > 0 && duration <= 3600) return;
  char value[32];
  std::snprintf(value, sizeof value, "%g", duration);
  throw InputError("wetcloth: --duration = " + std::string(value) + ": must be in (0, 3600] s");
}

}  // namespace

Scene readScene(const SceneOptions& options, char** arguments) {
  if (options.duration) requireDuration(*options.duration);
  Scene scene = readScene(options.scene);
  if (options.precision.empty()) {
    continueInPrecision(scene.precision, scene.file + ": /precision", arguments);
  } else {
    continueInPrecision(valueOf(precisionNames(), options.precision), "wetcloth: --precision", arguments);
  }
  if (options.duration) scene.duration = *options.duration;
  if (!options.quality.empty()) scene.quality = options.quality;
  if (!scene.quality.empty()) apply(steppingWithin(scene, allowedError(valueOf(qualityNames(), scene.quality))), scene);
  return scene;
}

}  // namespace command
