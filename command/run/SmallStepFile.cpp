// SPDX-License-Identifier: Zlib
#include "command/run/SmallStepFile.h"

#include "command/cli/Errors.h"

#include "command/pictures/LittleEndian.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <stdexcept>

namespace command {

SmallStepFile::SmallStepFile(const std::string& path, const Scene& scene)
    : m_option(onOneLine("wetcloth: --small-steps = \"" + path + "\"")) {
  if (path.empty()) return;
  if (!scene.clothSolver) throw InputError(m_option + ": must be left out without --solver wetcloth");
  m_staged.emplace(m_option, path, StagedOutput::Kind::file);
}

void SmallStepFile::follow(SceneWorld& world) {
  if (!m_staged) return;
  try {
    m_file.emplace(m_staged->path());
  } catch (const std::runtime_error& error) {
    throw RunError(onOneLine(m_option + ": " + error.what()));
  }
  writeHead(world);
  m_substeps = static_cast<std::uint32_t>(world.steps() * world.scene().substeps);  // of a run that is resumed
  world.clothSolver()->setSmallStepCallback(
      [this, &world](const wetcloth::ClothSolver::SmallStepView& view) { write(world, view); });
}

void SmallStepFile::writeHead(const SceneWorld& world) {
  const Scene& scene = world.scene();
  const double substep = scene.step / scene.substeps;
  nlohmann::ordered_json head = {{"wetcloth_small_steps", 1},
                                 {"substep_s", substep},
                                 {"small_steps", wetcloth::ClothSolver::smallStepsOf(*scene.clothSolver, substep)},
                                 {"nodes", nlohmann::ordered_json::array()}};
  for (const btSoftBody* body : world.bodies()) head["nodes"].push_back(body->m_nodes.size());
  m_file->stream() << head.dump() << '\n';
}

// In double precision also in float32: relative to the solver's origin it knows places better than btScalar holds them.
void SmallStepFile::write(const SceneWorld& world, const wetcloth::ClothSolver::SmallStepView& view) {
  const auto body = std::find(world.bodies().begin(), world.bodies().end(), &view.body);
  const int nodes = view.body.m_nodes.size();
  m_bytes.clear();
  pictures::putUint32(m_bytes, m_substeps - 1);
  pictures::putInt32(m_bytes, view.index);
  pictures::putInt32(m_bytes, static_cast<int>(body - world.bodies().begin()));
  pictures::putInt32(m_bytes, nodes);
  for (int i = 0; i < nodes; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const double relative = static_cast<double>(view.x[axis][view.slots[i]]);
      pictures::putDouble(m_bytes, static_cast<double>(view.origin[axis]) + relative);
    }
  }
  m_file->stream() << m_bytes;
}

void SmallStepFile::finish() {
  if (!m_file) return;
  try {
    m_file->close();
  } catch (const std::runtime_error& error) {
    throw RunError(onOneLine(m_option + ": " + error.what()));
  }
  m_staged->commit();
}

}  // namespace command
