// SPDX-License-Identifier: Zlib
#pragma once

#include "command/stability/CaseScene.h"
#include "command/stability/HardCase.h"

#include <functional>
#include <string>
#include <vector>

/// What several cases are made of.
namespace stability {

/// All but that of pure computation.
const std::vector<World>& everyWorld();

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr int kNodes = 8;  ///< of a side of most cases' cloths: small, since there are many of them

/// A square of 1 m x 1 m, upright in the plane z = 0, its bottom at y = 0, free.
wetcloth::ClothPatch uprightCloth(int nodes = kNodes);
/// The same, hanging from its top edge.
wetcloth::ClothPatch hangingCloth(int nodes = kNodes);
/// The same size, level at this height, free.
wetcloth::ClothPatch levelCloth(double height, int nodes = kNodes);

/// A case in every world with a cloth that air and water act on.
HardCase everywhere(std::string name, std::string group, std::string about);

/// Mass of all nodes that are free [kg].
double freeMass(const btSoftBody& body);

/// Force of air of this speed [m/s] that strikes an area [m^2] broadside [N], by Wind's defaults.
double windForce(double speed, double area = 1);

/// Springs that a cloth of this mass [kg], hanging from one edge of `columns` nodes, stretches by a thousandth of a
/// metre [N/m]: stiff beside its weight, as real cloth is.
double stiffnessFor(double mass, int columns = kNodes);

/// Air and water about a cloth. In plain Bullet and the naive methods nothing gets wet, and in plain Bullet an
/// application's own safe wind blows, so that Bullet's solvers have the same to bear without us.
class Weather {
 public:
  enum class Kind {
    wind,  ///< nothing but wind
    rain   ///< as on a washing day: rain soaks the cloth, water spreads, drips and dries, the wind blows
  };
  /// @param cloth  of this body; null where it cannot get wet
  Weather(CaseScene& scene, btSoftBody& body, wetcloth::WetCloth* cloth, Kind kind, const btVector3& air,
          double skinFriction = 0.02);

  void blow(const btVector3& air);
  const btVector3& air() const { return m_air; }
  /// To be called before each step. From Limits::calmFrom on the air is still.
  void beforeStep();

 private:
  CaseScene& m_scene;
  btSoftBody& m_body;
  wetcloth::Wind* m_wind = nullptr;
  btVector3 m_air;
  double m_skinFriction;
};

/// Nothing but the weather goes on.
Script underWeather(CaseScene& scene, btSoftBody& body, wetcloth::WetCloth* cloth, Weather::Kind kind,
                    const btVector3& air);

/// Gives the nodes of a body this water [kg] from the beginning: by us, or in plain Bullet as constant masses.
void giveWater(CaseScene& scene, btSoftBody& body, wetcloth::WetCloth* cloth, const std::vector<double>& held);

/// Numbers in [0, 1) that are the same in each run and on each machine.
class Repeatable {
 public:
  explicit Repeatable(unsigned start) : m_state(start) {}
  double next() {
    m_state = m_state * 1664525U + 1013904223U;
    return static_cast<double>(m_state >> 8) / 16777216.;
  }

 private:
  unsigned m_state;
};

}  // namespace stability
