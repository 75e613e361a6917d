// SPDX-License-Identifier: Zlib
#include "command/scene/FallingDrops.h"

#include <algorithm>
#include <cmath>

namespace command {
namespace {

constexpr double longestFall = 3;  // [s], 44 m: nothing that a picture shows is so far down

double radiusOf(double mass, double density) { return std::cbrt(3 * mass / (4 * 3.14159265358979 * density)); }

}  // namespace

FallingDrops::FallingDrops(const Scene& scene)
    : m_gravity(scene.gravity), m_waterDensity(scene.water ? scene.water->density : WaterScene{}.density) {
  for (const Collider& collider : scene.colliders) {
    if (const auto* plane = collider.as<Plane>()) m_floors.push_back(*plane);
  }
  if (scene.water) m_floors.push_back({scene.up(), scene.water->level});
}

void FallingDrops::follow(wetcloth::Dripping& dripping) {
  const auto take = [this](const wetcloth::Drip& drip) {
    m_falls.push_back({drip.time, drip.position, drip.velocity, radiusOf(drip.mass, m_waterDensity)});
  };
  adjust(dripping, [&](auto& p) { p.onDrip = take; });
}

void FallingDrops::forgetLanded(double time) {
  const auto landed = [&](const Fall& fall) { return hasLanded(fall, time); };
  m_falls.erase(std::remove_if(m_falls.begin(), m_falls.end(), landed), m_falls.end());
}

std::vector<FallingDrop> FallingDrops::at(double time) const {
  std::vector<FallingDrop> drops;
  for (const Fall& fall : m_falls) {
    if (!hasLanded(fall, time)) drops.push_back({positionOf(fall, time), fall.radius});
  }
  return drops;
}

btVector3 FallingDrops::positionOf(const Fall& fall, double time) const {
  const auto age = static_cast<btScalar>(time - fall.start);
  return fall.position + fall.velocity * age + m_gravity * (age * age / 2);
}

bool FallingDrops::hasLanded(const Fall& fall, double time) const {
  if (time - fall.start > longestFall) return true;
  const btVector3 position = positionOf(fall, time);
  return std::any_of(m_floors.begin(), m_floors.end(), [&](const Plane& floor) {
    return static_cast<double>(floor.normal.dot(position)) < floor.offset;
  });
}

}  // namespace command
