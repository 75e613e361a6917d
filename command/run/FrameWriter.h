// SPDX-License-Identifier: Zlib
#pragma once

#include "command/run/FrameShot.h"

#include <string>
#include <vector>

namespace command {

/// Pictures of a run, evenly spaced from its first state to its last: frame_0000.svg and so on. They are kept as
/// positions until the end, because one camera has to see them all.
class FrameWriter {
 public:
  /// Throws InputError when pictures are wanted and the directory cannot be made or written to.
  FrameWriter(std::string directory, int count, int steps);

  bool isOn() const { return !m_directory.empty(); }
  int count() const { return static_cast<int>(m_shots.size()); }
  /// Takes a shot if this step is one of those wanted.
  void offer(const SceneWorld& world, int step);
  /// Throws RunError when a file cannot be written.
  void write(const SceneWorld& world) const;

 private:
  int stepOfShot(int shot) const;

  std::string m_directory;
  int m_count;
  int m_steps;
  std::vector<FrameShot> m_shots;
};

}  // namespace command
