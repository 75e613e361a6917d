// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/drops/DropsState.h"

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// One substep of Drops: what flies, what lands, what begins to fly.
class Drops::Flight {
 public:
  /// @param flown  length of the substep that has ended at `time` [s]
  Flight(State& state, WetClothWorld& world, double flown, double time);

  void run();

 private:
  struct Hit {
    double time = 2;
    State::Followed* cloth = nullptr;
    ClothTarget::Hit face;
    BodyTargets::Hit body;
    bool isNone() const { return time > 1; }
  };

  void look();
  void forgetGoneBodies();
  void flyAll();
  bool fly(std::size_t i);
  void shedFrom(State::Followed& followed);
  void pour();
  void begin(const Double3& from, const Double3& velocity, double mass, double rest);

  Double3 windAt(const Double3& place, double time);
  DropPath pathOf(const Double3& from, const Double3& velocity, double diameter, double dt, Double3& velocityAfter);
  Hit firstHit(const DropPath& path, const State::Followed* from = nullptr, int node = -1);
  void meetSurface(const DropPath& path, Hit& hit) const;
  // What of a drop goes on.
  struct Rest {
    double mass = 0;  // [kg]; 0: nothing
    Double3 position = {0, 0, 0};
    Double3 velocity = {0, 0, 0};
  };
  Rest land(const Hit& hit, const DropPath& path, const Double3& velocity, double mass);
  double landOnCloth(const Hit& hit, const DropPath& path, const Double3& velocity, double mass, Rest& rest);
  double landOnBody(const BodyTargets::Hit& hit, const Double3& velocity, double mass, Rest& rest);
  void flyOn(const Rest& rest);
  Double3 runsOn(const Double3& velocity, const Double3& ground, const Double3& normal) const;
  void tell(const Landing& landing);

  State& m_state;
  WetClothWorld& m_world;
  double m_flown;
  double m_time;
  btVector3 m_gravity;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
