// SPDX-License-Identifier: Zlib
#include "command/scene/EffectReaders.h"

#include "command/scene/ReadParameters.h"

#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace command {

using wetcloth::Absorption;
using wetcloth::ContactWetting;
using wetcloth::Immersion;
using wetcloth::Rain;
using wetcloth::Splash;

namespace {

constexpr double radiansPerDegree = SIMD_RADS_PER_DEG;

Splash::Sphere readStreamSphere(JsonCursor cursor) {
  cursor.expectObject(keys::streamSphere);
  return {readVector(cursor.at("centre_m")), cursor.at("radius_m").number(Range::positive())};
}

Splash::Cone readStreamCone(JsonCursor cursor) {
  cursor.expectObject(keys::streamCone);
  Splash::Cone cone;
  cone.apex = readVector(cursor.at("apex_m"));
  cone.halfAngle = radiansPerDegree * cursor.at("half_angle_deg").number(Range{0, 90, false, "in (0, 90)", false});
  cone.reach = cursor.at("reach_m").number(Range::positive());
  return cone;
}

/// The film of water on a collider, by the collider's place in the scene.
struct Film {
  std::size_t collider;
  double water;  ///< [kg]
};

std::vector<Film> readFilms(const JsonCursor& cursor, const Scene& scene) {
  if (scene.colliders.empty() && !cursor.elements().empty()) cursor.complain("the scene has no colliders to be wet");
  std::vector<Film> films;
  std::set<int> seen;
  for (JsonCursor film : cursor.elements()) {
    film.expectObject(keys::film);
    const int collider = film.at("collider").integer(0, static_cast<int>(scene.colliders.size()) - 1);
    if (!seen.insert(collider).second) film.at("collider").complain("has a film already");
    films.push_back({static_cast<std::size_t>(collider), film.at("water_kg").number(Range::notNegative())});
  }
  return films;
}

/// Whether a cloth exchanges water with others, of which Bullet has to list the contacts.
bool readCloths(const JsonCursor& cursor, const EffectContext& context) {
  if (!cursor.boolean()) return false;
  using Flag = btSoftBody::fCollision;
  const bool isDeformable = context.scene.world == WorldKind::deformable;
  if ((context.cloth.collisions.value_or(0) & (isDeformable ? Flag::VF_DD : Flag::VF_SS)) == 0) {
    cursor.complain(std::string("the cloth's \"collisions\" must have ") + (isDeformable ? "VF_DD" : "VF_SS"));
  }
  return true;
}

}  // namespace

AddEffect readAbsorption(JsonCursor cursor, const EffectContext& context) {
  using Law = Absorption::Law;
  static const std::vector<std::pair<std::string, Law>> laws{
      {"exponential", Law::exponential}, {"forward_euler", Law::forwardEuler}, {"ramp", Law::ramp}};
  cursor.expectObject(keys::absorption);
  Absorption::Parameters parameters;
  if (readMode(cursor) == Mode::paper) parameters = Absorption::Parameters::paper();
  if (const auto exposure = cursor.find("exposure"))
    parameters.exposure = readExposure(*exposure, context.cloth.nodeCount());
  if (const auto law = cursor.find("law")) parameters.law = law->choice(laws);
  if (const auto water = cursor.find("water_velocity_m_s")) parameters.waterVelocity = readVector(*water);
  if (const auto conserves = cursor.find("conserves_momentum")) {
    parameters.conservesMomentum = conserves->boolean();
  }
  readNumber(cursor, "ramp_duration_s", Range::positive(), parameters.rampDuration);
  return addEffect<Absorption>(parameters);
}

AddEffect readImmersion(JsonCursor cursor, const EffectContext& context) {
  cursor.expectObject(keys::immersion);
  requireWater(cursor, context.scene);
  return addEffect<Immersion>({});
}

AddEffect readRain(JsonCursor cursor, const EffectContext&) {
  cursor.expectObject(keys::rain);
  Rain::Parameters parameters;
  readDirection(cursor, "direction", parameters.direction);
  readNumber(cursor, "flux_kg_m2_s", Range::notNegative(), parameters.flux);
  readNumber(cursor, "speed_m_s", Range::notNegative(), parameters.speed);
  if (const auto shelter = cursor.find("self_shelter")) parameters.selfShelter = shelter->boolean();
  return addEffect<Rain>(parameters);
}

AddEffect readSplash(JsonCursor cursor, const EffectContext&) {
  cursor.expectObject(keys::splash);
  Splash::Parameters parameters;
  if (cursor.exactlyOneOf({"sphere", "cone"}) == "sphere") {
    parameters.region = readStreamSphere(cursor.at("sphere"));
  } else {
    parameters.region = readStreamCone(cursor.at("cone"));
  }
  parameters.velocity = readDirection(cursor.at("velocity_m_s"));
  readNumber(cursor, "flux_kg_m2_s", Range::notNegative(), parameters.flux);
  return addEffect<Splash>(parameters);
}

AddEffect readContactWetting(JsonCursor cursor, const EffectContext& context) {
  cursor.expectObject(keys::contactWetting);
  ContactWetting::Parameters parameters;
  if (const auto cloths = cursor.find("cloths")) parameters.cloths = readCloths(*cloths, context);
  readNumber(cursor, "rate_kg_m2_s", Range::notNegative(), parameters.rate);
  std::vector<Film> films;
  if (const auto found = cursor.find("films")) films = readFilms(*found, context.scene);
  return [=](wetcloth::WetCloth& cloth, const Colliders& colliders) -> wetcloth::Effect& {
    ContactWetting::Parameters placed = parameters;
    for (const Film& film : films) placed.wetBodies.push_back({colliders[film.collider], film.water});
    return cloth.add<ContactWetting>(placed);
  };
}

}  // namespace command
