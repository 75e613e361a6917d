// SPDX-License-Identifier: Zlib
#include "command/scene/ValidateCommand.h"

#include "command/cli/CommonOptions.h"
#include "command/scene/SceneOptions.h"
#include "command/scene/SceneReader.h"
#include "command/scene/SceneWorld.h"

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace command {
namespace {

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
    const SceneWorld world(scene);  // what only the library knows to refuse, it refuses here
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
