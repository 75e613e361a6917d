// SPDX-License-Identifier: Zlib
#pragma once

#include "command/run/DripRecord.h"
#include "command/run/Saturation.h"
#include "command/scene/MeasuredFront.h"
#include "command/scene/SceneWorld.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace command {

struct RunTimes {
  int steps = 0;
  double wetMilliseconds = 0;               ///< per step, with the library
  std::optional<double> plainMilliseconds;  ///< per step, the same scene in plain Bullet; none: it was not stepped
};

/// What a run came to.
class RunReport {
 public:
  RunReport(const SceneWorld& world, const RunTimes& times, const DripRecord& drips);

  /// Why the scene was stepped as it was, and how far off that may be.
  void explain(const SteppingChoice& stepping) { m_stepping = stepping; }

  nlohmann::ordered_json json() const;
  /// The same, short, for people.
  std::string summary() const;

 private:
  void measureBody(const btSoftBody& body);
  void measureCloth(const wetcloth::WetCloth& cloth);
  void askSolver(const SceneWorld& world);
  bool hasGuard() const { return m_scene.clothSolver && m_scene.clothSolver->guard; }
  double ofRealTime() const;
  std::string timeLine() const;
  std::string waterLines() const;
  std::string auditLine() const;
  std::string steppingLine() const;
  std::string solverLine() const;
  std::string stopsLine() const;
  std::string springsLine() const;

  const Scene& m_scene;
  RunTimes m_times;
  std::optional<SteppingChoice> m_stepping;
  std::string m_hash;
  DripRecord m_drips;
  int m_nodes = 0;
  int m_links = 0;
  std::vector<std::string> m_effects;
  wetcloth::Ledger m_ledger;
  std::optional<wetcloth::WorldLedger> m_drops;
  std::optional<wetcloth::AuditTotals> m_audit;  // of all cloths that have one
  Saturation m_saturation;
  double m_moment[3] = {0, 0, 0};  // mass x position [kg m]
  double m_mass = 0;
  double m_maxSpeed = 0;
  double m_maxStretch = 0;
  wetcloth::ClothSolver::GuardTotals m_guard;
  /// Why ClothSolver did not take a cloth, by its pointer in the scene.
  std::vector<std::pair<std::string, std::string>> m_solverReasons;
  std::vector<double> m_springs;  // stiffness of Bullet's own, where cloths have them [N/m]
};

}  // namespace command
