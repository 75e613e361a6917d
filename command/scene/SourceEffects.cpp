// SPDX-License-Identifier: Zlib
#include "command/scene/EffectGroups.h"

#include "command/scene/ColliderSurface.h"
#include "command/scene/ReadParameters.h"

#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace command {
namespace {

using wetcloth::Absorption;
using wetcloth::ContactWetting;
using wetcloth::Immersion;
using wetcloth::Rain;
using wetcloth::Splash;

const KeyTable& streamSphereKeys() {
  static const KeyTable keys{"streamSphere", {"centre_m", "radius_m"}};
  return keys;
}

const KeyTable& streamConeKeys() {
  static const KeyTable keys{"streamCone", {"apex_m", "half_angle_deg", "reach_m"}};
  return keys;
}

const KeyTable& filmKeys() {
  static const KeyTable keys{"film", {"collider", "water_kg", "figure", "water_kg_m2"}};
  return keys;
}

constexpr double radiansPerDegree = SIMD_RADS_PER_DEG;

Splash::Sphere readStreamSphere(JsonCursor cursor) {
  cursor.expectObject(streamSphereKeys());
  return {readVector(cursor.at("centre_m")), cursor.at("radius_m").number(Range::positive())};
}

Splash::Cone readStreamCone(JsonCursor cursor) {
  cursor.expectObject(streamConeKeys());
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

Film readColliderFilm(const JsonCursor& cursor, const Scene& scene) {
  const int collider = cursor.at("collider").integer(0, static_cast<int>(scene.colliders.size()) - 1);
  return {static_cast<std::size_t>(collider), cursor.at("water_kg").number(Range::notNegative())};
}

/// Skin that is equally wet all over.
std::vector<Film> readFigureFilms(const JsonCursor& cursor, const Scene& scene) {
  std::vector<std::pair<std::string, FigureScene>> choices;
  for (const FigureScene& figure : scene.figures) choices.emplace_back(figure.name, figure);
  if (choices.empty()) cursor.at("figure").complain("the scene has no figures");
  const FigureScene figure = cursor.at("figure").choice(choices);
  const double perArea = cursor.at("water_kg_m2").number(Range::notNegative());
  std::vector<Film> films;
  for (std::size_t i = figure.first; i < figure.first + figure.count; ++i) {
    films.push_back({i, perArea * areaOf(scene.colliders[i])});
  }
  return films;
}

std::vector<Film> readFilms(const JsonCursor& cursor, const Scene& scene) {
  if (scene.colliders.empty() && !cursor.elements().empty()) cursor.complain("the scene has no colliders to be wet");
  std::vector<Film> films;
  std::set<std::size_t> seen;
  for (JsonCursor element : cursor.elements()) {
    element.expectObject(filmKeys());
    const std::string whose = element.exactlyOneOf({"collider", "figure"});
    const std::vector<Film> found =
        whose == "figure" ? readFigureFilms(element, scene) : std::vector<Film>{readColliderFilm(element, scene)};
    for (const Film& film : found) {
      if (!seen.insert(film.collider).second) element.at(whose).complain("has a film already");
    }
    films.insert(films.end(), found.begin(), found.end());
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

AddEffect readAbsorption(const JsonCursor& cursor, const EffectContext& context) {
  using Law = Absorption::Law;
  static const std::vector<std::pair<std::string, Law>> laws{
      {"exponential", Law::exponential}, {"forward_euler", Law::forwardEuler}, {"ramp", Law::ramp}};
  Absorption::Parameters parameters;
  if (readMode(cursor) == Mode::paper) parameters = Absorption::Parameters::paper();
  if (const auto exposure = cursor.find("exposure"))
    parameters.exposure = readExposure(*exposure, context.cloth.nodeCount());
  if (const auto law = cursor.find("law")) parameters.law = law->choice(laws);
  if (const auto water = cursor.find("water_velocity_m_s"))
    parameters.waterVelocity = readVector(*water, Range::velocity());
  if (const auto conserves = cursor.find("conserves_momentum")) {
    parameters.conservesMomentum = conserves->boolean();
  }
  readNumber(cursor, "ramp_duration_s", Range::positive(), parameters.rampDuration);
  return addEffect<Absorption>(parameters);
}

EffectEntry absorption() {
  EffectEntry entry;
  entry.key = "absorption";
  entry.about =
      "`exposure` is a number, an array with one for each node, or `{\"below_m\": y}`; `\"mode\": \"paper\"` is the "
      "ramp of the paper's Table II";
  entry.keys = {"absorption",
                {"mode", "exposure", "law", "water_velocity_m_s", "conserves_momentum", "ramp_duration_s"}};
  entry.read = readAbsorption;
  entry.byDefault = addDefault<Absorption>;
  entry.water = WaterRole::brings;
  return entry;
}

AddEffect readImmersion(const JsonCursor&, const EffectContext&) { return addEffect<Immersion>({}); }

EffectEntry immersion() {
  EffectEntry entry;
  entry.key = "immersion";
  entry.about = "nodes below the scene's `water` soak; `{}` does";
  entry.keys = {"immersion", {}};
  entry.read = readImmersion;
  entry.byDefault = addDefault<Immersion>;
  entry.needs.water = true;
  entry.water = WaterRole::brings;
  return entry;
}

AddEffect readRain(const JsonCursor& cursor, const EffectContext&) {
  Rain::Parameters parameters;
  readDirection(cursor, "direction", parameters.direction);
  readNumber(cursor, "flux_kg_m2_s", Range::notNegative(), parameters.flux);
  readNumber(cursor, "speed_m_s", Range::speed(), parameters.speed);
  if (const auto shelter = cursor.find("self_shelter")) parameters.selfShelter = shelter->boolean();
  return addEffect<Rain>(parameters);
}

EffectEntry rain() {
  EffectEntry entry;
  entry.key = "rain";
  entry.about = "1 mm/h is 1/3600 kg/m^2/s; what the cloth cannot hold runs off";
  entry.keys = {"rain", {"direction", "flux_kg_m2_s", "speed_m_s", "self_shelter"}};
  entry.read = readRain;
  entry.byDefault = [](const Scene& scene) {
    Rain::Parameters parameters;
    parameters.direction = -scene.up();
    return addEffect<Rain>(parameters);
  };
  entry.needs.faces = true;
  entry.water = WaterRole::brings;
  return entry;
}

AddEffect readSplash(const JsonCursor& cursor, const EffectContext&) {
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

EffectEntry splash() {
  EffectEntry entry;
  entry.key = "splash";
  entry.about =
      "in a `sphere`, `{\"centre_m\", \"radius_m\"}`, or a `cone`, `{\"apex_m\", \"half_angle_deg\", \"reach_m\"}`; "
      "this region and `velocity_m_s` must be there; in a cone the flux is that at its far end";
  entry.keys = {"splash", {"sphere", "cone", "velocity_m_s", "flux_kg_m2_s"}};
  entry.parts = {streamSphereKeys(), streamConeKeys()};
  entry.read = readSplash;
  entry.example = {{"sphere", {{"centre_m", {0.5, 0.5, 0}}, {"radius_m", 0.2}}}, {"velocity_m_s", {0, 0, 5}}};
  entry.needs.faces = true;
  entry.water = WaterRole::brings;
  return entry;
}

AddEffect readContactWetting(const JsonCursor& cursor, const EffectContext& context) {
  ContactWetting::Parameters parameters;
  if (const auto cloths = cursor.find("cloths")) parameters.cloths = readCloths(*cloths, context);
  readNumber(cursor, "rate_kg_m2_s", Range::notNegative(), parameters.rate);
  std::vector<Film> films;
  if (const auto found = cursor.find("films")) films = readFilms(*found, context.scene);
  return [=](wetcloth::WetCloth& cloth, const Colliders& colliders) -> wetcloth::Effect& {
    ContactWetting::Parameters placed = parameters;
    for (const Film& film : films) placed.wetBodies.push_back({colliders[film.collider], film.water});
    return putEffect<ContactWetting>(cloth, placed);
  };
}

EffectEntry contactWetting() {
  EffectEntry entry;
  entry.key = "contact_wetting";
  entry.about = "takes up from wet colliders, exchanges with other cloths";
  entry.keys = {"contactWetting", {"films", "cloths", "rate_kg_m2_s"}};
  entry.parts = {filmKeys()};
  entry.read = readContactWetting;
  entry.example = {{"films", {{{"collider", 0}, {"water_kg", 1}}}}};
  entry.needs.contacts = true;
  entry.water = WaterRole::brings;
  return entry;
}

}  // namespace

EffectCatalogue sourceEffects() { return {absorption(), immersion(), rain(), splash(), contactWetting()}; }

}  // namespace command
