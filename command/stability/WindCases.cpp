// SPDX-License-Identifier: Zlib
#include "command/stability/CaseParts.h"
#include "command/stability/Cases.h"
#include "command/stability/NaiveMethods.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

// Winds that would carry light cloth away in one step.
namespace stability {
namespace {

using Air = std::function<btVector3(const CaseScene& scene)>;

constexpr const char* kExplicitWind = "explicit wind";

/// The wind blows for half of the time; then the cloth may come to rest.
Script blown(CaseScene& scene, btSoftBody& body, double speed, const Air& air, double skinFriction = 0.01) {
  double mass = 0;
  for (const double one : naive::massesOf(body)) mass += one;
  scene.limits.source = speed;
  scene.limits.drop = 2;
  scene.limits.force = mass * scene.gravity() + windForce(speed);
  scene.limits.calmFrom = scene.duration() / 2;
  const auto weather =
      std::make_shared<Weather>(scene, body, scene.wet(body), Weather::Kind::wind, btVector3(0, 0, 0), skinFriction);
  Script script;
  script.before = [=, &scene, &body] {
    if (scene.time() < scene.limits.calmFrom) weather->blow(air(scene));
    weather->beforeStep();
    if (scene.isNaive()) naive::pushByWind(body, weather->air(), scene.dt());
  };
  return script;
}

HardCase windOf(double speed) {
  const std::string number = std::to_string(static_cast<int>(speed));
  HardCase hardCase = everywhere("wind_" + number, "winds", "a hanging cloth in a wind of " + number + " m/s");
  hardCase.duration = 6;
  if (speed > 0) hardCase.naiveMethod = kExplicitWind;
  hardCase.build = [=](CaseScene& scene) {
    btSoftBody& body = scene.add(hangingCloth(), std::max(1000., windForce(speed)));
    const btVector3 velocity = btVector3(btScalar(0.28), 0, btScalar(0.96)) * btScalar(speed);
    return blown(scene, body, speed, [=](const CaseScene&) { return velocity; });
  };
  return hardCase;
}

HardCase reversing() {
  HardCase hardCase = everywhere("wind_reversing", "winds", "50 m/s, the other way round in each step");
  hardCase.duration = 6;
  hardCase.naiveMethod = kExplicitWind;
  hardCase.build = [](CaseScene& scene) {
    btSoftBody& body = scene.add(hangingCloth(), windForce(50));
    return blown(scene, body, 50, [](const CaseScene& at) { return btVector3(0, 0, at.steps() % 2 == 0 ? 50 : -50); });
  };
  return hardCase;
}

HardCase alongThePlane() {
  HardCase hardCase = everywhere("wind_along_the_plane", "winds", "50 m/s along a hanging cloth, with skin friction");
  hardCase.duration = 6;
  hardCase.build = [](CaseScene& scene) {
    btSoftBody& body = scene.add(hangingCloth(), windForce(50));
    return blown(
        scene, body, 50, [](const CaseScene&) { return btVector3(50, 0, 0); }, 0.05);
  };
  return hardCase;
}

/// Symmetry: air that slips along a flat sheet has no side to push it to.
HardCase edgeOn() {
  HardCase hardCase = everywhere("wind_edge_on", "winds", "100 m/s exactly along a flat free sheet: nothing may move");
  hardCase.isWeightless = true;
  hardCase.build = [](CaseScene& scene) {
    btSoftBody& body = scene.add(uprightCloth(), 1000);
    wetcloth::WetCloth* const cloth = scene.wet(body);
    if (cloth != nullptr) cloth->add<wetcloth::Wind>({btVector3(60, 80, 0)});
    Script script;
    script.observe = [&body](CaseMeter& meter) {
      double farthest = 0;
      for (int i = 0; i < body.m_nodes.size(); ++i)
        farthest = std::max(farthest, std::fabs(double(body.m_nodes[i].m_x.z())));
      meter.compare("position drift", farthest, 0);
    };
    return script;
  };
  return hardCase;
}

HardCase crumpled() {
  HardCase hardCase = everywhere("wind_on_crumpled_cloth", "winds", "50 m/s on a cloth whose nodes were thrown about");
  hardCase.duration = 6;
  hardCase.naiveMethod = kExplicitWind;
  hardCase.build = [](CaseScene& scene) {
    auto body = hangingCloth().build(scene.worldInfo());
    // Bullet would take the crumpled lengths for the rest lengths.
    body->updateConstants();
    body->m_bUpdateRtCst = false;
    Repeatable random(7);
    for (int i = 0; i < body->m_nodes.size(); ++i) {
      if (!(body->m_nodes[i].m_im > 0)) continue;
      const auto some = [&] { return btScalar(0.1 * (random.next() - 0.5)); };
      const btScalar x = some();
      const btScalar y = some();
      body->m_nodes[i].m_x += btVector3(x, y, some());
      body->m_nodes[i].m_q = body->m_nodes[i].m_x;
    }
    return blown(scene, scene.add(std::move(body), windForce(50)), 50,
                 [](const CaseScene&) { return btVector3(30, 0, 40); });
  };
  return hardCase;
}

HardCase lightNodes() {
  HardCase hardCase = everywhere("wind_on_light_nodes", "winds", "30 m/s on a free sheet of 1 g/m^2, weightless");
  hardCase.isWeightless = true;
  hardCase.naiveMethod = kExplicitWind;
  hardCase.build = [](CaseScene& scene) {
    wetcloth::ClothPatch patch = uprightCloth();
    patch.arealDensity = 1e-3;
    Script script =
        blown(scene, scene.add(patch, windForce(30)), 30, [](const CaseScene&) { return btVector3(0, 0, 30); });
    return script;
  };
  return hardCase;
}

}  // namespace

std::vector<HardCase> windCases() {
  return {windOf(0), windOf(50), windOf(200), reversing(), alongThePlane(), edgeOn(), crumpled(), lightNodes()};
}

}  // namespace stability
