// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/numerics/DropFlight.h"

#include <LinearMath/btVector3.h>

#include <array>
#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class StateArchive;

/// Three numbers as double, in either precision.
using Double3 = std::array<double, 3>;

/// The drops in flight, in arrays: no more than a number of them, the nearest of which merge.
class DropList {
 public:
  /// Room for this many drops, >= 1. Those that are there already and would be too many merge. Allocates.
  void setMost(std::size_t most, double waterDensity);

  std::size_t size() const { return m_mass.size(); }
  double mass(std::size_t i) const { return m_mass[i]; }          ///< [kg]
  double diameter(std::size_t i) const { return m_diameter[i]; }  ///< [m]
  double age(std::size_t i) const { return m_age[i]; }            ///< since it began to fly [s]
  Double3 position(std::size_t i) const { return {m_position[0][i], m_position[1][i], m_position[2][i]}; }  ///< [m]
  Double3 velocity(std::size_t i) const { return {m_velocity[0][i], m_velocity[1][i], m_velocity[2][i]}; }  ///< [m/s]

  /// A new drop. When there is room for no more it joins the nearest one, at the place where that is: mass and momentum
  /// are those of both.
  void add(const Double3& position, const Double3& velocity, double mass);
  /// The last one takes the place of this one.
  void remove(std::size_t i);
  void move(std::size_t i, const Double3& position, const Double3& velocity, double dt);
  /// Some of it has gone.
  void setMass(std::size_t i, double mass);

  /// All drops [kg].
  double total() const;
  /// How often a drop has joined another one.
  long long merged() const { return m_merged; }

  void transferState(StateArchive& archive);

 private:
  std::size_t nearest(const Double3& position) const;
  void resize(std::size_t count);
  void join(std::size_t i, const Double3& velocity, double mass);

  std::size_t m_most = 1;
  double m_waterDensity = 1000;
  std::array<std::vector<double>, 3> m_position;
  std::array<std::vector<double>, 3> m_velocity;
  std::vector<double> m_mass;
  std::vector<double> m_diameter;
  std::vector<double> m_age;
  long long m_merged = 0;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
