#include "SceneOptions.h"

#include "Errors.h"
#include "SceneReader.h"
#include "Sibling.h"

#include <algorithm>
#include <cstdio>

namespace runner {
namespace {

void requireDuration(double duration) {
  if (duration > 0 && duration <= 3600) return;
  char value[32];
  std::snprintf(value, sizeof value, "%g", duration);
  throw InputError("wetcloth: --duration = " + std::string(value) + ": must be in (0, 3600] s");
}

}  // namespace

const std::vector<std::pair<std::string, Quality>>& qualityNames() {
  static const std::vector<std::pair<std::string, Quality>> names{{"draft", Quality::draft},
                                                                  {"realtime", Quality::realtime},
                                                                  {"accurate", Quality::accurate},
                                                                  {"reference", Quality::reference}};
  return names;
}

void scaleQuality(Scene& scene, Quality quality) {
  const double factor = quality == Quality::draft       ? 0.5
                        : quality == Quality::accurate  ? 2
                        : quality == Quality::reference ? 4
                                                        : 1;
  scene.substeps = std::max(1, static_cast<int>(scene.substeps * factor));
  scene.iterations = std::max(1, static_cast<int>(scene.iterations * factor));
}

Scene readScene(const SceneOptions& options, char** arguments) {
  if (options.duration) requireDuration(*options.duration);
  Scene scene = readScene(options.scene);
  if (options.precision.empty()) {
    continueInPrecision(scene.precision, scene.file + ": /precision", arguments);
  } else {
    continueInPrecision(valueOf(precisionNames(), options.precision), "wetcloth: --precision", arguments);
  }
  if (options.duration) scene.duration = *options.duration;
  scaleQuality(scene, valueOf(qualityNames(), options.quality));
  return scene;
}

}  // namespace runner
