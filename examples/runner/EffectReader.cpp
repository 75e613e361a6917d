#include "EffectReader.h"

#include <cmath>

namespace runner {
namespace {

using wetcloth::Absorption;
using wetcloth::CollisionAudit;
using wetcloth::HookeSprings;
using wetcloth::Wind;

enum class Mode { physical, paper };

btVector3 readVector(const JsonCursor& cursor) {
  const std::array<double, 3> xyz = cursor.triple();
  return btVector3(btScalar(xyz[0]), btScalar(xyz[1]), btScalar(xyz[2]));
}

void readNumber(const JsonCursor& object, const char* key, const Range& range, double& value) {
  if (const auto found = object.find(key)) value = found->number(range);
}

/// The defaults of an effect: the library's own, or the paper's letter by letter.
Mode readMode(const JsonCursor& cursor) {
  static const std::vector<std::pair<std::string, Mode>> modes{{"physical", Mode::physical}, {"paper", Mode::paper}};
  const auto mode = cursor.find("mode");
  return mode ? mode->choice(modes) : Mode::physical;
}

wetcloth::Exposure readExposure(JsonCursor cursor, int nodes) {
  if (cursor.isArray()) {
    std::vector<double> perNode;
    for (const JsonCursor& element : cursor.elements()) perNode.push_back(element.number(Range::fraction()));
    if (perNode.size() != static_cast<std::size_t>(nodes)) {
      cursor.reject("one value per node, " + std::to_string(nodes) + " here; it has " + std::to_string(perNode.size()));
    }
    return perNode;
  }
  if (!cursor.isObject()) return cursor.number(Range::fraction());
  cursor.expectObject(keys::exposureBelow);
  const double surface = cursor.at("below_m").number(Range::finite());
  return [surface](const btVector3& position, const btVector3&) {
    return static_cast<double>(position.y()) < surface ? 1.0 : 0.0;
  };
}

Absorption::Parameters readAbsorption(JsonCursor cursor, int nodes) {
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
  return parameters;
}

/// Gusts that travel with the mean wind, as turbulence does that passes faster than it changes (Taylor 1938):
/// mean + amplitude sin(2 pi (t - x . mean / |mean|^2) / period).
wetcloth::WindField readGust(JsonCursor cursor) {
  cursor.expectObject(keys::gust);
  const btVector3 mean = readVector(cursor.at("mean_m_s"));
  const btVector3 amplitude = readVector(cursor.at("amplitude_m_s"));
  const double period = cursor.at("period_s").number(Range::positive());
  const btScalar speed2 = mean.length2();
  const btVector3 delay = speed2 > 0 ? btVector3(mean / speed2) : btVector3(0, 0, 0);
  return [=](const btVector3& position, double time) {
    const double turns = (time - static_cast<double>(position.dot(delay))) / period;
    return btVector3(mean + amplitude * btScalar(std::sin(SIMD_2_PI * turns)));
  };
}

Wind::Parameters readWind(JsonCursor cursor) {
  using Law = Wind::Law;
  using Integration = Wind::Integration;
  static const std::vector<std::pair<std::string, Law>> laws{
      {"quadratic", Law::quadratic}, {"linear", Law::linear}, {"paper", Law::paper}};
  static const std::vector<std::pair<std::string, Integration>> integrations{
      {"semi_implicit", Integration::semiImplicit}, {"explicit_euler", Integration::explicitEuler}};
  cursor.expectObject(keys::wind);
  Wind::Parameters parameters;
  if (readMode(cursor) == Mode::paper) parameters.law = Law::paper;
  if (cursor.exactlyOneOf({"velocity_m_s", "gust"}) == "gust") {
    parameters.velocity = readGust(cursor.at("gust"));
  } else {
    parameters.velocity = readVector(cursor.at("velocity_m_s"));
  }
  if (const auto law = cursor.find("law")) parameters.law = law->choice(laws);
  if (const auto found = cursor.find("integration")) parameters.integration = found->choice(integrations);
  readNumber(cursor, "air_density_kg_m3", Range::notNegative(), parameters.airDensity);
  readNumber(cursor, "drag_coefficient", Range::notNegative(), parameters.dragCoefficient);
  readNumber(cursor, "skin_friction", Range::notNegative(), parameters.skinFriction);
  readNumber(cursor, "linear_drag_n_s_m3", Range::notNegative(), parameters.linearDrag);
  readNumber(cursor, "paper_force_n", Range::notNegative(), parameters.paperForce);
  return parameters;
}

HookeSprings::Parameters readHookeSprings(JsonCursor cursor) {
  cursor.expectObject(keys::hookeSprings);
  HookeSprings::Parameters parameters;
  readNumber(cursor, "stiffness_n_m", Range::positive(), parameters.stiffness);
  readNumber(cursor, "bending_stiffness_n_m", Range::notNegative(), parameters.bendingStiffness);
  if (const auto iterations = cursor.find("iterations")) parameters.iterations = iterations->integer(1, 10000);
  return parameters;
}

CollisionAudit::Parameters readCollisionAudit(JsonCursor cursor) {
  using wetcloth::collision::Tier;
  static const std::vector<std::pair<std::string, Tier>> tiers{
      {"fast", Tier::fast}, {"conservative", Tier::conservative}, {"exact", Tier::exact}};
  cursor.expectObject(keys::collisionAudit);
  CollisionAudit::Parameters parameters;
  if (const auto self = cursor.find("self")) parameters.self = self->boolean();
  if (const auto others = cursor.find("others")) parameters.others = others->boolean();
  if (const auto tier = cursor.find("tier")) parameters.tier = tier->choice(tiers);
  return parameters;
}

}  // namespace

void readEffects(JsonCursor cursor, int nodes, ClothScene& cloth) {
  cursor.expectObject(keys::effects);
  if (const auto found = cursor.find("absorption")) cloth.absorption = readAbsorption(*found, nodes);
  if (const auto found = cursor.find("wind")) cloth.wind = readWind(*found);
  if (const auto found = cursor.find("hooke_springs")) cloth.hookeSprings = readHookeSprings(*found);
  if (const auto found = cursor.find("collision_audit")) cloth.collisionAudit = readCollisionAudit(*found);
}

}  // namespace runner
