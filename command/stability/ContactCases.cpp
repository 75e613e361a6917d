// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/bullet/Versions.h"
#include "command/stability/CaseParts.h"
#include "command/stability/Cases.h"
#include "command/stability/NaiveMethods.h"

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

// Pins and bodies: what holds the cloth, drags it along, or squeezes it.
namespace stability {
namespace {

wetcloth::ClothPatch clothWithPins(std::vector<int> pins) {
  wetcloth::ClothPatch patch = uprightCloth();
  patch.pinnedNodes = std::move(pins);
  return patch;
}

void setWeatherLimits(CaseScene& scene, const btSoftBody& body, double speed) {
  scene.limits.source = speed;
  scene.limits.drop = 2;
  scene.limits.force = 1.84 * freeMass(body) * scene.gravity() + windForce(speed);
  scene.limits.calmFrom = scene.duration() / 2;
}

HardCase pinnedEverywhere() {
  HardCase hardCase = everywhere("pinned_everywhere", "contacts", "every node is pinned: nothing may move");
  hardCase.build = [](CaseScene& scene) {
    std::vector<int> all;
    for (int i = 0; i < kNodes * kNodes; ++i) all.push_back(i);
    btSoftBody& body = scene.add(clothWithPins(all), 1000);
    const auto weather =
        std::make_shared<Weather>(scene, body, scene.wet(body), Weather::Kind::rain, btVector3(3, 0, 10));
    auto start = std::make_shared<std::vector<btVector3>>();
    for (int i = 0; i < body.m_nodes.size(); ++i) start->push_back(body.m_nodes[i].m_x);
    Script script;
    script.before = [weather] { weather->beforeStep(); };
    script.observe = [start, &body](CaseMeter& meter) {
      for (int i = 0; i < body.m_nodes.size(); ++i) {
        const btVector3 moved = body.m_nodes[i].m_x - (*start)[static_cast<std::size_t>(i)];
        meter.compare("position drift", double(moved.length()), 0);
      }
    };
    return script;
  };
  return hardCase;
}

HardCase pinnedNowhere() {
  HardCase hardCase = everywhere("pinned_nowhere", "contacts", "a free cloth falls to the floor in wind and rain");
  hardCase.duration = 6;
  hardCase.build = [](CaseScene& scene) {
    scene.addFloor(0);
    btSoftBody& body = scene.add(levelCloth(0.5), 1000);
    scene.collide(body);
    wetcloth::WetCloth* const cloth = scene.wet(body);
    if (cloth != nullptr) cloth->add<wetcloth::Cling>();
    setWeatherLimits(scene, body, 3);
    scene.limits.drop = 0.5;
    return underWeather(scene, body, cloth, Weather::Kind::rain, btVector3(1, 0, 0));
  };
  return hardCase;
}

HardCase pinnedAtOneNode() {
  HardCase hardCase = everywhere("pinned_at_one_node", "contacts", "hangs from one corner in wind and rain");
  // It swings about its corner, and only the air takes that away: quadratic drag lets energy fall as 1 / t^2.
  hardCase.duration = 40;
  hardCase.quickDuration = 8;
  hardCase.build = [](CaseScene& scene) {
    btSoftBody& body = scene.add(clothWithPins({kNodes * (kNodes - 1)}), 10000);
    setWeatherLimits(scene, body, 8.3);
    scene.limits.drop = 2 * std::sqrt(2.);
    return underWeather(scene, body, scene.wet(body), Weather::Kind::rain, btVector3(2, 0, 8));
  };
  return hardCase;
}

HardCase movingPins() {
  HardCase hardCase =
      everywhere("moving_pins", "contacts", "the pinned edge is shaken by 30 cm twice a second, in rain");
  hardCase.duration = 8;
  hardCase.build = [](CaseScene& scene) {
    constexpr double amplitude = 0.3;
    constexpr double rate = 2 * kPi * 2;
    btSoftBody& body = scene.add(hangingCloth(), 1000);
    const auto weather =
        std::make_shared<Weather>(scene, body, scene.wet(body), Weather::Kind::rain, btVector3(0, 0, 0));
    auto starts = std::make_shared<std::vector<btVector3>>();
    for (int i = 0; i < body.m_nodes.size(); ++i) starts->push_back(body.m_nodes[i].m_x);
    setWeatherLimits(scene, body, std::max(3., amplitude * rate));
    scene.limits.drop = 2 + 2 * amplitude;
    // The cloth must follow its pins: its mass times their acceleration.
    scene.limits.force += 1.84 * freeMass(body) * amplitude * rate * rate;
    Script script;
    script.before = [=, &scene, &body] {
      weather->beforeStep();
      const double time = std::min(scene.time() + scene.dt(), scene.limits.calmFrom);
      const btVector3 offset(0, btScalar(amplitude * std::sin(rate * time)),
                             btScalar(amplitude * (1 - std::cos(rate * time))));
      for (int i = 0; i < body.m_nodes.size(); ++i) {
        if (!(body.m_nodes[i].m_im > 0)) body.m_nodes[i].m_x = (*starts)[static_cast<std::size_t>(i)] + offset / 2;
      }
    };
    return script;
  };
  return hardCase;
}

HardCase spinningSphere() {
  HardCase hardCase = everywhere("spinning_sphere", "contacts", "a wet cloth falls on a sphere that spins at 10 rad/s");
  hardCase.build = [](CaseScene& scene) {
    constexpr double radius = 0.4;
    constexpr double spin = 10;
    btRigidBody& sphere = scene.addRigid(std::make_unique<btSphereShape>(btScalar(radius)), 0, btVector3(0, 0, 0));
    btSoftBody& body = scene.add(levelCloth(radius + 0.1), 1000);
    scene.collide(body);
    wetcloth::WetCloth* const cloth = scene.wet(body);
    if (cloth != nullptr) {
      cloth->add<wetcloth::Wind>({btVector3(0, 0, 0)});
      cloth->add<wetcloth::Cling>();
      cloth->add<wetcloth::WetFriction>();
      wetcloth::ContactWetting::Parameters wetting;
      wetting.wetBodies = {{&sphere, 0.05}};
      cloth->add<wetcloth::ContactWetting>(wetting);
      cloth->setSaturation(0.3);
    }
    scene.limits.source = spin * std::sqrt(0.5);  // the corners reach as far as half the diagonal
    scene.limits.drop = 1 + scene.gravity() * scene.duration() * scene.duration() / 2;  // it may be thrown off
    scene.limits.force = freeMass(body) * 2 * (scene.gravity() + spin * spin);
    Script script;
    script.before = [&scene, &sphere] {
      const btScalar angle = btScalar(std::fmod(spin * (scene.time() + scene.dt()), 2 * kPi));
      moveKinematic(sphere, btVector3(0, 0, 0), btQuaternion(btVector3(0, 1, 0), angle), scene.dt());
    };
    return script;
  };
  return hardCase;
}

/// Where along a straight way between two times, [0, 1].
double along(double time, double from, double to) { return std::clamp((time - from) / (to - from), 0., 1.); }

HardCase throughAGap() {
  HardCase hardCase = everywhere("through_a_gap", "contacts", "a wet cloth is pulled through a gap of 12 cm at 1 m/s");
  hardCase.duration = 4;
  hardCase.build = [](CaseScene& scene) {
    for (const double side : {-1., 1.}) {
      scene.addRigid(std::make_unique<btBoxShape>(btVector3(2, btScalar(0.1), btScalar(0.5))), 0,
                     btVector3(0, btScalar(-0.4), btScalar(side * 0.56)));
    }
    wetcloth::ClothPatch patch = levelCloth(0);
    patch.pinnedNodes = {kNodes * kNodes / 2 + kNodes / 2};  // pulled by its middle
    btSoftBody& body = scene.add(patch, 1000);
    scene.collide(body);
    body.m_cfg.kDF = btScalar(0.1);  // with much friction it jams, and rightly so
    wetcloth::WetCloth* const cloth = scene.wet(body);
    const auto weather = std::make_shared<Weather>(scene, body, cloth, Weather::Kind::rain, btVector3(0, 0, 0));
    if (cloth != nullptr) cloth->add<wetcloth::WetFriction>();
    const int pin = patch.pinnedNodes[0];
    const btVector3 start = body.m_nodes[pin].m_x - btVector3(0, 0, body.m_nodes[pin].m_x.z());
    setWeatherLimits(scene, body, 3);
    scene.limits.drop = 2;
    scene.limits.calmFrom = 2;
    scene.limits.force += 100;  // of the edges, which hold back by friction: far more than the cloth's weight
    Script script;
    script.before = [=, &scene, &body] {
      weather->beforeStep();
      body.m_nodes[pin].m_x = start - btVector3(0, btScalar(1.5 * along(scene.time() + scene.dt(), 0.2, 1.7)), 0);
    };
    return script;
  };
  return hardCase;
}

HardCase pinched() {
  HardCase hardCase =
      everywhere("pinched", "contacts", "two bodies close on a hanging wet cloth, thinner than its margins");
  hardCase.duration = 4;
  hardCase.build = [](CaseScene& scene) {
    std::vector<btRigidBody*> jaws;
    for (int side = 0; side < 2; ++side) {
      jaws.push_back(&scene.addRigid(std::make_unique<btBoxShape>(btVector3(1, btScalar(0.2), btScalar(0.2))), 0,
                                     btVector3(btScalar(0.5), btScalar(0.4), side == 0 ? -1 : 1)));
    }
    btSoftBody& body = scene.add(hangingCloth(), 1000);
    scene.collide(body);
    wetcloth::WetCloth* const cloth = scene.wet(body);
    const auto weather = std::make_shared<Weather>(scene, body, cloth, Weather::Kind::rain, btVector3(0, 0, 0));
    if (cloth != nullptr) cloth->add<wetcloth::Cling>();
    setWeatherLimits(scene, body, 3);
    Script script;
    script.before = [=, &scene] {
      weather->beforeStep();
      // From 80 cm apart to 1 cm, and open again
      const double time = scene.time() + scene.dt();
      const double closed = along(time, 0.2, 1.2) - along(time, 1.6, 1.8);
      const double gap = 0.4 - 0.395 * closed;
      for (std::size_t side = 0; side < 2; ++side) {
        const btVector3 centre(btScalar(0.5), btScalar(0.4), btScalar((side == 0 ? -1 : 1) * (0.2 + gap)));
        moveKinematic(*jaws[side], centre, btQuaternion::getIdentity(), scene.dt());
      }
    };
    return script;
  };
  return hardCase;
}

HardCase underLoad() {
  HardCase hardCase =
      everywhere("under_50_times_its_weight", "contacts", "a box of 50 times its mass lies on a wet cloth");
  hardCase.build = [](CaseScene& scene) {
    scene.addFloor(0);
    btSoftBody& body = scene.add(levelCloth(0.03), 1000);
    scene.collide(body);
    const double mass = freeMass(body);
    scene.addRigid(std::make_unique<btBoxShape>(btVector3(btScalar(0.3), btScalar(0.1), btScalar(0.3))), 50 * mass,
                   btVector3(0, btScalar(0.16), 0));
    wetcloth::WetCloth* const cloth = scene.wet(body);
    const auto weather = std::make_shared<Weather>(scene, body, cloth, Weather::Kind::rain, btVector3(0, 0, 0));
    setWeatherLimits(scene, body, 3);
    scene.limits.drop = 0.2;
    scene.limits.force += 50 * mass * scene.gravity();
    Script script;
    script.before = [weather] { weather->beforeStep(); };
    return script;
  };
  return hardCase;
}

HardCase clothOnCloth() {
  HardCase hardCase = everywhere("cloth_on_cloth", "contacts", "a dry cloth falls on a wet one, which wets it");
  if (!wetcloth::keepsFaceContacts()) hardCase.worlds = {World::softRigid, World::softMultiBody};
  hardCase.build = [](CaseScene& scene) {
    scene.addFloor(0);
    std::vector<wetcloth::WetCloth*> cloths;
    for (const double height : {0.05, 0.3}) {
      btSoftBody& body = scene.add(levelCloth(height), 1000);
      scene.collide(body, true);
      cloths.push_back(scene.wet(body));
      setWeatherLimits(scene, body, 3);
    }
    if (scene.isNaive() || !scene.isOurs()) return Script{};
    cloths[0]->setSaturation(1);
    for (wetcloth::WetCloth* const cloth : cloths) {
      wetcloth::ContactWetting::Parameters wetting;
      wetting.cloths = true;
      cloth->add<wetcloth::ContactWetting>(wetting);
      cloth->add<wetcloth::Wind>({btVector3(0, 0, 0)});
    }
    return Script{};
  };
  return hardCase;
}

}  // namespace

std::vector<HardCase> contactCases() {
  return {pinnedEverywhere(), pinnedNowhere(), pinnedAtOneNode(), movingPins(),  spinningSphere(),
          throughAGap(),      pinched(),       underLoad(),       clothOnCloth()};
}

}  // namespace stability
