// SPDX-License-Identifier: Zlib
#include "command/run/FrameWriter.h"

#include "command/cli/Errors.h"
#include "command/cli/StagedOutput.h"
#include "command/run/SvgFrame.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>

namespace command {
namespace {

void requireWritable(const std::string& directory) {
  std::error_code failed;
  std::filesystem::create_directories(directory, failed);
  const std::filesystem::path probe = std::filesystem::path(directory) / "frame_0000.svg";
  std::error_code ignored;
  const bool isNew = !std::filesystem::exists(probe, ignored);
  if (!failed && std::ofstream(probe, std::ios::app)) {
    if (isNew) std::filesystem::remove(probe, ignored);  // a run that fails leaves no empty picture
    return;
  }
  throw InputError("wetcloth: --frames = \"" + directory + "\": must be a directory that can be written to");
}

}  // namespace

FrameWriter::FrameWriter(std::string directory, int count, int steps)
    : m_directory(std::move(directory)), m_count(std::min(count, steps + 1)), m_steps(steps) {
  if (isOn()) requireWritable(m_directory);
}

int FrameWriter::stepOfShot(int shot) const {
  if (m_count < 2) return m_steps;
  return static_cast<int>(static_cast<long long>(shot) * m_steps / (m_count - 1));
}

void FrameWriter::offer(const SceneWorld& world, int step) {
  if (isOn() && count() < m_count && step == stepOfShot(count())) {
    m_shots.push_back(takeShot(world, step * world.scene().step));
  }
}

void FrameWriter::write(const SceneWorld& world) const {
  if (!isOn()) return;
  const Camera camera = fitCamera(world.scene(), m_shots);
  for (int i = 0; i < count(); ++i) {
    char name[32];
    std::snprintf(name, sizeof name, "frame_%04d.svg", i);
    const std::filesystem::path path = std::filesystem::path(m_directory) / name;
    const std::string option = "wetcloth: --frames = \"" + path.string() + "\"";
    StagedOutput output(option, path.string(), StagedOutput::Kind::file);
    std::ofstream file(output.path(), std::ios::binary | std::ios::trunc);
    file << svgFrame(world, camera, m_shots[static_cast<std::size_t>(i)]) << std::flush;
    if (!file) throw RunError(option + ": could not be written");
    file.close();
    output.commit();
  }
}

}  // namespace command
