#pragma once

#include "Scene.h"

#include <optional>
#include <string>

namespace runner {

enum class Quality { draft, realtime, accurate, reference };
const std::vector<std::pair<std::string, Quality>>& qualityNames();
/// Substeps and iterations, of both so many times as many.
void scaleQuality(Scene& scene, Quality quality);

struct RunOptions {
  std::string scene;
  std::string frames;  ///< directory; empty: no pictures
  int frameCount = 12;
  std::string json;
  std::string quality = "realtime";
  std::string precision;           ///< empty: as the scene says
  std::optional<double> duration;  ///< [s]; none: as the scene says
};

/// `wetcloth run`. @param arguments of the program, for its sibling of the other precision
void runScene(const RunOptions& options, char** arguments);

}  // namespace runner
