// SPDX-License-Identifier: Zlib
#pragma once

#include "command/cost/CostRun.h"
#include "command/cost/CostStatistics.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace command {

/// What the samples of a CostRun say.
class CostReport {
 public:
  /// A difference beside what could be told at all.
  struct Finding {
    double value = 0;
    double noise = 0;
    bool isBelowNoise() const { return !(value > noise); }
  };

  explicit CostReport(const CostRun& run);

  nlohmann::ordered_json json() const;
  /// The same for people.
  std::string text() const;

 private:
  struct Cost {
    std::string name;
    CostEstimate ours;       ///< of our part of the step; of the guard, which is in Bullet's, the whole [s]
    CostEstimate wholeStep;  ///< also of what it makes Bullet do [s]
    double floor;            ///< below which `ours` cannot be told [s]
  };

  Finding percent(const CostEstimate& difference, double floor) const;
  Finding oursPercent(const Cost& cost) const { return percent(cost.ours, cost.floor); }
  Finding wholePercent(const Cost& cost) const { return percent(cost.wholeStep, m_wholeFloor); }
  Finding idlePercent() const;
  double nanosecondsPerNode(double seconds) const { return 1e9 * seconds / m_run.nodes(); }
  nlohmann::ordered_json jsonOf(const Cost& cost) const;
  std::string head() const;
  std::string row(const Cost& cost) const;

  const CostRun& m_run;
  double m_bullet = 0;      // a step of plain Bullet [s]
  double m_oursFloor = 0;   // what the parts of two identical worlds differ by [s]
  double m_wholeFloor = 0;  // what their whole steps differ by [s]
  CostEstimate m_idleRatio;
  Cost m_all;
  std::vector<Cost> m_effects;
};

}  // namespace command
