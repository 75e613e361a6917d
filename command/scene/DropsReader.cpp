// SPDX-License-Identifier: Zlib
#include "command/scene/DropsReader.h"

#include "command/scene/ReadParameters.h"

#include <LinearMath/btQuaternion.h>

#include <algorithm>
#include <memory>
#include <string>

namespace command {
namespace {

Range diameters() { return {0, 0.1, false, "in (0, 0.1]"}; }

/// Of a spout, in straight lines from time to time.
struct SpoutMotion {
  btVector3 start;
  std::vector<double> times;
  std::vector<btVector3> offsets;

  btVector3 at(double time) const {
    const auto next = static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), time) - times.begin());
    const std::size_t to = std::min(next, times.size() - 1);
    const std::size_t from = next == 0 ? 0 : next - 1;
    const double share = from == to ? 0 : (time - times[from]) / (times[to] - times[from]);
    return start + offsets[from] + (offsets[to] - offsets[from]) * btScalar(share);
  }
};

void readSpoutMotion(JsonCursor cursor, wetcloth::Pour& pour) {
  cursor.expectObject(keys::motion);
  SpoutMotion motion{pour.position, readTimes(cursor.at("times_s")), {}};
  motion.offsets = readForEachTime(cursor.at("offsets_m"), motion.times.size());
  pour.move = [motion](wetcloth::Pour& spout, double time) { spout.position = motion.at(time); };
}

wetcloth::Pour readPour(JsonCursor cursor) {
  cursor.expectObject(keys::pour);
  wetcloth::Pour pour;
  pour.position = readVector(cursor.at("position_m"));
  pour.flow = cursor.at("flow_kg_s").number(Range::notNegative());
  readVector(cursor, "velocity_m_s", pour.velocity, Range::velocity());
  readNumber(cursor, "drop_diameter_m", diameters(), pour.dropDiameter);
  readNumber(cursor, "mouth_radius_m", Range::notNegative(), pour.mouthRadius);
  if (const auto angle = cursor.find("half_angle_deg")) {
    pour.halfAngle = static_cast<double>(SIMD_RADS_PER_DEG) * angle->number(Range{0, 89, true, "from 0 to 89"});
  }
  readNumber(cursor, "start_s", Range::notNegative(), pour.start);
  if (const auto stop = cursor.find("stop_s")) {
    pour.stop = stop->number(Range::notNegative());
    if (pour.stop < pour.start) stop->complain("must be no earlier than start_s");
  }
  if (const auto motion = cursor.find("motion")) readSpoutMotion(*motion, pour);
  return pour;
}

DropsScene::FullGlass readGlass(JsonCursor cursor, const Scene& scene) {
  cursor.expectObject(keys::glass);
  if (scene.colliders.empty()) cursor.complain("the scene has no colliders, and a glass is one");
  DropsScene::FullGlass full;
  const JsonCursor number = cursor.at("collider");
  full.collider = static_cast<std::size_t>(number.integer(0, static_cast<int>(scene.colliders.size()) - 1));
  const auto* cylinder = scene.colliders[full.collider].as<Cylinder>();
  if (cylinder == nullptr) number.complain("must be a cylinder, whose end to_m is the open one");
  const btVector3 axis = cylinder->to - cylinder->from;
  full.glass.radius = cylinder->radius;
  full.glass.height = static_cast<double>(axis.length());
  full.rest = btTransform(shortestArcQuat(btVector3(0, 1, 0), axis.normalized()), cylinder->from);
  const double most =
      wetcloth::DropAir().waterDensity * SIMD_PI * full.glass.radius * full.glass.radius * full.glass.height;
  const JsonCursor water = cursor.at("water_kg");
  full.glass.water = water.number(Range::notNegative());
  if (full.glass.water > most) water.reject("no more than it holds, " + std::to_string(most));
  readNumber(cursor, "drop_diameter_m", diameters(), full.glass.dropDiameter);
  return full;
}

}  // namespace

DropsScene readDrops(JsonCursor cursor, const Scene& scene) {
  cursor.expectObject(keys::drops);
  DropsScene drops;
  wetcloth::Drops::Parameters& parameters = drops.parameters;
  if (const auto wind = cursor.find("wind_m_s")) parameters.wind = readVector(*wind, Range::velocity());
  readNumber(cursor, "drop_mass_kg", Range::positive(), parameters.dropMass);
  if (const auto most = cursor.find("most")) parameters.mostDrops = most->integer(1, 10000000);
  readNumber(cursor, "longest_flight_s", Range::positive(), parameters.longestFlight);
  readNumber(cursor, "film_kg_m2", Range::notNegative(), parameters.filmDensity);
  readNumber(cursor, "film_cell_m", Range::positive(), parameters.filmCell);
  if (const auto pours = cursor.find("pours")) {
    for (const JsonCursor& pour : pours->elements()) drops.pours.push_back(readPour(pour));
  }
  if (const auto glasses = cursor.find("glasses")) {
    for (const JsonCursor& glass : glasses->elements()) {
      const DropsScene::FullGlass full = readGlass(glass, scene);
      for (const DropsScene::FullGlass& other : drops.glasses) {
        if (other.collider == full.collider) glass.complain("its collider is a glass already");
      }
      drops.glasses.push_back(full);
    }
  }
  if (scene.water) {
    parameters.surface = wetcloth::WaterSurface();
    parameters.surface->normal = scene.up();
    parameters.surface->offset = -scene.water->level;
  }
  return drops;
}

}  // namespace command
