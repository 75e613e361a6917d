// SPDX-License-Identifier: Zlib
#pragma once

#include "command/cli/StagedOutput.h"
#include "command/scene/SceneWorld.h"

#include "command/pictures/OutputFile.h"

#include <cstdint>
#include <optional>
#include <string>

namespace command {

/// The nodes' places after each small step of ClothSolver, in a file whose format docs/scenes.md describes.
class SmallStepFile {
 public:
  /// Throws InputError when a file is wanted and cannot be made, or when the scene is on Bullet's own solver.
  /// @param path  empty: no file is wanted
  SmallStepFile(const std::string& path, const Scene& scene);
  SmallStepFile(const SmallStepFile&) = delete;
  SmallStepFile& operator=(const SmallStepFile&) = delete;

  /// From now on writes what this world does, which is gone before this is.
  void follow(SceneWorld& world);
  /// To be called before each substep.
  void beginSubstep() { ++m_substeps; }
  /// After the last step. Throws RunError when not all could be written.
  void finish();

 private:
  void writeHead(const SceneWorld& world);
  void write(const SceneWorld& world, const wetcloth::ClothSolver::SmallStepView& view);

  std::string m_option;
  std::optional<StagedOutput> m_staged;  // none: no file is wanted
  std::optional<pictures::OutputFile> m_file;
  std::uint32_t m_substeps = 0;  // begun so far
  std::string m_bytes;           // of one record
};

}  // namespace command
