// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/SceneWorld.h"

#include <nlohmann/json.hpp>

#include <array>
#include <string>

namespace command {

/// How a run's cloths drip in the course of time, those that have the effect.
class DripRecord {
 public:
  /// @param steps  of the run
  explicit DripRecord(int steps) : m_steps(steps) {}

  /// After each step of the run.
  void note(const SceneWorld& world);

  /// What was noted so far, and to go on from that.
  nlohmann::ordered_json progress() const;
  /// @param stepsMade  of the run, at most all of them
  void goOnFrom(const nlohmann::ordered_json& progress, int stepsMade);

  /// Whether a cloth has the effect.
  bool isOn() const { return m_isOn; }
  nlohmann::ordered_json json() const;
  /// The same, short, for people.
  std::string line() const;

 private:
  int m_steps;
  int m_noted = 0;
  bool m_isOn = false;
  long long m_drops = 0;
  double m_mass = 0;     // that has dripped [kg]
  double m_pending = 0;  // of it, what is no full drop yet [kg]
  std::array<double, 10> m_massByTenth{};
};

}  // namespace command
