// SPDX-License-Identifier: Zlib
#include "command/scene/ValidateCommand.h"

#include "command/cli/CommonOptions.h"
#include "command/cli/Errors.h"
#include "command/scene/SceneOptions.h"
#include "command/scene/SceneReader.h"
#include "command/scene/SceneWorld.h"
#include "command/scene/StandIn.h"

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace command {
namespace {

/// What only the library knows to refuse, it refuses here.
void requireAccepted(const Scene& scene) {
  const Scene small = standIn(scene);
  try {
    const SceneWorld world(small);
  } catch (const InputError&) {
    // It may be the stand-in's fault, for whom an array with a number for each node is too long.
    const SceneWorld world(scene);
  }
}

void validateScenes(const std::vector<std::string>& files) {
  const std::string schemaEnding = ".schema.json";
  for (const std::string& file : files) {
    // A schema lies beside its scenes, and a shell's *.json takes it along.
    if (file.size() > schemaEnding.size() &&
        file.compare(file.size() - schemaEnding.size(), schemaEnding.size(), schemaEnding) == 0) {
      std::printf("%s: a schema, not a scene; skipped\n", file.c_str());
      continue;
    }
    const Scene scene = readScene(file);
    requireAccepted(scene);
    tellHints(scene);
    std::printf("%s: ok\n", file.c_str());
  }
}

}  // namespace

Command addValidateCommand(CLI::App& line) {
  CLI::App* const app = line.add_subcommand("validate", "Check scenes without running them");
  const auto files = std::make_shared<std::vector<std::string>>();
  app->add_option("scenes", *files, "Scene files")->required();
  return {app, [files] { validateScenes(*files); }};
}

}  // namespace command
