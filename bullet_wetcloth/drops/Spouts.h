// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/drops/DropList.h"
#include "bullet_wetcloth/drops/Pour.h"

#include <LinearMath/btTransform.h>
#include <LinearMath/btVector3.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class StateArchive;

/// The spouts and glasses of a world, and when which drop leaves them.
class Spouts {
 public:
  /// Takes a drop that leaves: `rest` is the time from then to the end of the substep [s].
  using Give = std::function<void(const Double3& position, const Double3& velocity, double mass, double rest)>;
  /// A substep that has ended.
  struct Substep {
    double end;         ///< [s]
    double dt;          ///< [s], > 0
    btVector3 gravity;  ///< [m/s^2]
    double waterDensity;
  };

  std::size_t add(Pour pour);
  std::size_t add(Glass glass);
  std::size_t pours() const { return m_pours.size(); }
  const Pour& pour(std::size_t number) const { return m_pours.at(number).pour; }
  void setPour(std::size_t number, Pour pour) { m_pours.at(number).pour = std::move(pour); }
  std::size_t glasses() const { return m_glasses.size(); }
  double waterIn(std::size_t glass) const { return m_glasses.at(glass).water + m_glasses.at(glass).due; }

  /// Whether anything may come in the substep between these times.
  bool mayPour(double begin, double end) const;
  /// What comes in a substep. Returns what an application's function threw, in words; empty: nothing.
  std::string pour(const Substep& substep, const Give& give);

  void transferState(StateArchive& archive);

 private:
  struct RunningPour {
    Pour pour;
    double due = 0;       // what has come and is no full drop yet [kg]
    long long drops = 0;  // so far
  };
  struct RunningGlass {
    Glass glass;
    double water = 0;  // in it [kg]
    double due = 0;    // of it, what is over the rim and is no full drop yet [kg]
    long long drops = 0;
    btTransform last = btTransform::getIdentity();  // pose
    bool hasPose = false;
  };

  static void run(RunningPour& running, const Substep& substep, const Give& give);
  static void run(RunningGlass& running, const Substep& substep, const Give& give);

  std::vector<RunningPour> m_pours;
  std::vector<RunningGlass> m_glasses;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
