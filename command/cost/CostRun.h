// SPDX-License-Identifier: Zlib
#pragma once

#include "command/cost/CostWorld.h"

#include <string>
#include <vector>

namespace command {

/// Worlds that differ in one effect take turns at stepping the same scene, so that whatever else the machine does
/// slows all of them. What an effect costs is then the difference between two worlds, step by step.
class CostRun {
 public:
  /// One for each turn: the mean of its measured steps [s].
  struct Samples {
    std::vector<double> step;
    std::vector<double> ours;
  };

  /// @param scene of one substep a step
  explicit CostRun(const Scene& scene);

  /// One turn of each world, of at most `most` measured steps. Throws RunError when the scene blows up.
  void turn(int most);
  /// Why no more can be measured: a world that lacks an effect has blown up. Empty: more can.
  const std::string& obstacle() const { return m_obstacle; }
  /// Before each turn's measured steps: the caches hold another world when it begins.
  static constexpr int unmeasured = 1;
  /// As many as water's pace has substeps, so that each turn has one step in which water moves.
  int measuredPerTurn() const;

  const Scene& scene() const { return m_scene; }
  int nodes() const;
  int steps() const { return m_steps; }  ///< measured so far
  int worlds() const { return static_cast<int>(m_lanes.size()); }
  const std::vector<std::string>& effects() const { return m_effects; }
  /// Whether a cloth without effects is exactly where plain Bullet has moved it.
  bool isIdleSameAsPlain() const;

  const Samples& plain() const { return m_lanes[0].samples; }
  const Samples& idle() const { return m_lanes[1].samples; }
  const Samples& all() const { return m_lanes[2].samples; }
  /// Of a world that is the same as all(): how they differ is how well this machine can tell.
  const Samples& twin() const { return m_lanes[3].samples; }
  const Samples& without(std::size_t effect) const { return m_lanes[4 + effect].samples; }

 private:
  struct Lane {
    CostWorld world;
    Samples samples;
  };

  void stepLane(Lane& lane, int measured);
  void noticeBlowUp(int measured);
  std::string labelOf(std::size_t lane) const;

  const Scene& m_scene;
  std::vector<std::string> m_effects;
  std::vector<Lane> m_lanes;
  std::string m_obstacle;
  std::size_t m_turns = 0;
  int m_steps = 0;
};

}  // namespace command
