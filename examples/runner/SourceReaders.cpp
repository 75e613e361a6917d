#include "EffectReaders.h"

#include "ReadParameters.h"

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace runner {

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
  const Range angles{0, 90, false, "in (0, 90)"};
  const double degrees = cursor.at("half_angle_deg").number(angles);
  if (!(degrees < 90)) cursor.at("half_angle_deg").reject(angles.text);
  cone.halfAngle = radiansPerDegree * degrees;
  cone.reach = cursor.at("reach_m").number(Range::positive());
  return cone;
}

/// The film of water on a collider, by the collider's place in the scene.
struct Film {
  std::size_t collider;
  double water;  ///< [kg]
};

std::vector<Film> readFilms(const JsonCursor& cursor) {
  std::vector<Film> films;
  for (JsonCursor film : cursor.elements()) {
    film.expectObject(keys::film);
    const int collider = film.at("collider").integer(0, 1000000);
    films.push_back({static_cast<std::size_t>(collider), film.at("water_kg").number(Range::notNegative())});
  }
  return films;
}

}  // namespace

AddEffect readAbsorption(JsonCursor cursor, int nodes) {
  using Law = Absorption::Law;
  static const std::vector<std::pair<std::string, Law>> laws{
      {"exponential", Law::exponential}, {"forward_euler", Law::forwardEuler}, {"ramp", Law::ramp}};
  cursor.expectObject(keys::absorption);
  Absorption::Parameters parameters;
  if (readMode(cursor) == Mode::paper) parameters = Absorption::Parameters::paper();
  if (const auto exposure = cursor.find("exposure")) parameters.exposure = readExposure(*exposure, nodes);
  if (const auto law = cursor.find("law")) parameters.law = law->choice(laws);
  if (const auto water = cursor.find("water_velocity_m_s")) parameters.waterVelocity = readVector(*water);
  if (const auto conserves = cursor.find("conserves_momentum")) {
    parameters.conservesMomentum = conserves->boolean();
  }
  readNumber(cursor, "ramp_duration_s", Range::positive(), parameters.rampDuration);
  return addEffect<Absorption>(parameters);
}

AddEffect readImmersion(JsonCursor cursor, int) {
  cursor.expectObject(keys::immersion);
  return addEffect<Immersion>({});
}

AddEffect readRain(JsonCursor cursor, int) {
  cursor.expectObject(keys::rain);
  Rain::Parameters parameters;
  readVector(cursor, "direction", parameters.direction);
  readNumber(cursor, "flux_kg_m2_s", Range::notNegative(), parameters.flux);
  readNumber(cursor, "speed_m_s", Range::notNegative(), parameters.speed);
  if (const auto shelter = cursor.find("self_shelter")) parameters.selfShelter = shelter->boolean();
  return addEffect<Rain>(parameters);
}

AddEffect readSplash(JsonCursor cursor, int) {
  cursor.expectObject(keys::splash);
  Splash::Parameters parameters;
  if (cursor.exactlyOneOf({"sphere", "cone"}) == "sphere") {
    parameters.region = readStreamSphere(cursor.at("sphere"));
  } else {
    parameters.region = readStreamCone(cursor.at("cone"));
  }
  parameters.velocity = readVector(cursor.at("velocity_m_s"));
  readNumber(cursor, "flux_kg_m2_s", Range::notNegative(), parameters.flux);
  return addEffect<Splash>(parameters);
}

AddEffect readContactWetting(JsonCursor cursor, int) {
  cursor.expectObject(keys::contactWetting);
  ContactWetting::Parameters parameters;
  if (const auto cloths = cursor.find("cloths")) parameters.cloths = cloths->boolean();
  readNumber(cursor, "rate_kg_m2_s", Range::notNegative(), parameters.rate);
  std::vector<Film> films;
  if (const auto found = cursor.find("films")) films = readFilms(*found);
  return [=](wetcloth::WetCloth& cloth, const Colliders& colliders) -> wetcloth::Effect& {
    ContactWetting::Parameters placed = parameters;
    for (const Film& film : films) {
      if (film.collider >= colliders.size()) {
        throw std::invalid_argument("films: there is no collider " + std::to_string(film.collider));
      }
      placed.wetBodies.push_back({colliders[film.collider], film.water});
    }
    return cloth.add<ContactWetting>(placed);
  };
}

}  // namespace runner
