// SPDX-License-Identifier: Zlib
#include "command/stability/CaseParts.h"
#include "command/stability/Cases.h"
#include "command/stability/NaiveMethods.h"

#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>

// Masses that differ by many orders of magnitude, and change at once.
namespace stability {
namespace {

constexpr double kRounding = sizeof(btScalar) == sizeof(double) ? 2.3e-16 : 1.2e-7;

/// A hanging cloth in the weather for half of the time, then in still air.
Script inTheWeather(CaseScene& scene, btSoftBody& body, double capacity) {
  scene.limits.source = 10.2;
  scene.limits.drop = 2;
  scene.limits.force = freeMass(body) * (1 + capacity) * scene.gravity() + windForce(10.2);
  scene.limits.calmFrom = scene.duration() / 2;
  return underWeather(scene, body, scene.wet(body), Weather::Kind::rain, btVector3(2, 0, 10));
}

HardCase uniformMass(const std::string& name, double mass) {
  HardCase hardCase = everywhere("mass_" + name + "_kg", "masses", "every node weighs " + name + " kg, in the weather");
  hardCase.duration = 6;
  hardCase.build = [=](CaseScene& scene) {
    wetcloth::ClothPatch patch = hangingCloth();
    patch.arealDensity = mass * kNodes * kNodes;
    btSoftBody& body = scene.add(patch, stiffnessFor(2 * patch.arealDensity));
    return inTheWeather(scene, body, wetcloth::Fabric::cotton().capacity);
  };
  return hardCase;
}

HardCase unlikeNeighbours() {
  HardCase hardCase = everywhere("neighbours_1e4", "masses", "each node 10^4 times as heavy as its neighbours");
  hardCase.duration = 6;
  hardCase.build = [](CaseScene& scene) {
    auto body = hangingCloth().build(scene.worldInfo());
    for (int i = 0; i < body->m_nodes.size(); ++i) {
      btSoftBody::Node& node = body->m_nodes[i];
      const bool isHeavy = (i / kNodes + i % kNodes) % 2 == 0;
      if (node.m_im > 0) node.m_im = isHeavy ? 10 : btScalar(1e5);
    }
    body->updateLinkConstants();
    const double mass = freeMass(*body);
    return inTheWeather(scene, scene.add(std::move(body), stiffnessFor(2 * mass)), 0.84);
  };
  return hardCase;
}

HardCase oneWetNode() {
  HardCase hardCase = everywhere("one_wet_node", "masses", "one node holds 100 times its dry mass, all others are dry");
  hardCase.duration = 6;
  hardCase.build = [](CaseScene& scene) {
    btSoftBody& body = scene.add(hangingCloth(), 1000);
    wetcloth::Fabric fabric;
    fabric.capacity = 100;
    wetcloth::WetCloth* const cloth = scene.wet(body, fabric);
    const std::size_t middle = kNodes * (kNodes / 2) + kNodes / 2;
    std::vector<double> held(kNodes * kNodes, 0);
    held[middle] = 100 / double(body.m_nodes[static_cast<int>(middle)].m_im);
    giveWater(scene, body, cloth, held);
    scene.limits.drop = 1;
    scene.limits.force = freeMass(body) * scene.gravity();
    scene.limits.calmFrom = 0;
    return underWeather(scene, body, cloth, Weather::Kind::wind, btVector3(0, 0, 0));
  };
  return hardCase;
}

/// Saturation that a case sets by hand in each step.
double dryThenWet(const CaseScene& scene) {
  const double share = scene.time() / scene.duration();
  return share > 1. / 3 && share < 2. / 3 ? 0 : 1;
}

using WriteMasses = void (*)(btSoftBody& body, const std::vector<double>& dry, double factor);

/// Wet at first, dried to nothing in one step, and saturated again in one.
HardCase atOnce(const char* name, const char* naiveMethod, WriteMasses write) {
  HardCase hardCase = everywhere(name, "masses", "from saturation to dry in one step and back, at 3.5 times the mass");
  hardCase.naiveMethod = naiveMethod;
  hardCase.build = [=](CaseScene& scene) {
    const wetcloth::Fabric fabric = wetcloth::Fabric::highAbsorption();
    btSoftBody& body = scene.add(hangingCloth(), 1000);
    wetcloth::WetCloth* const cloth = scene.wet(body, fabric);
    if (cloth != nullptr) cloth->add<wetcloth::Wind>({btVector3(0, 0, 0)});
    const auto dry = std::make_shared<std::vector<double>>(naive::massesOf(body));
    scene.limits.drop = 0.1;
    scene.limits.force = freeMass(body) * (1 + fabric.capacity) * scene.gravity();
    scene.limits.calmFrom = 0;
    if (scene.isNaive()) naive::writeMassesWithoutMomentum(body, *dry, 1 + fabric.capacity);
    Script script;
    script.before = [=, &scene, &body] {
      const double saturation = dryThenWet(scene);
      if (cloth != nullptr) cloth->setSaturation(saturation);
      if (scene.isNaive()) write(body, *dry, 1 + saturation * fabric.capacity);
    };
    return script;
  };
  return hardCase;
}

HardCase absorbedAtOnce() {
  HardCase hardCase = everywhere("absorbed_in_one_step", "masses", "water of 7 m/s soaks a hanging cloth within 1 ns");
  hardCase.build = [](CaseScene& scene) {
    wetcloth::Fabric fabric = wetcloth::Fabric::highAbsorption();
    fabric.timeConstant = 1e-9;
    btSoftBody& body = scene.add(hangingCloth(), 1000);
    wetcloth::WetCloth* const cloth = scene.wet(body, fabric);
    if (cloth != nullptr) {
      wetcloth::Absorption::Parameters rain;
      rain.waterVelocity = btVector3(0, -5, 5);
      cloth->add<wetcloth::Absorption>(rain);
    } else {
      // In plain Bullet the cloth has the water's mass and momentum from the beginning.
      naive::writeMassesWithoutMomentum(body, naive::massesOf(body), 1 + fabric.capacity);
      const btScalar share = btScalar(fabric.capacity / (1 + fabric.capacity));
      for (int i = 0; i < body.m_nodes.size(); ++i) {
        btSoftBody::Node& node = body.m_nodes[i];
        if (node.m_im > 0) node.m_v = node.m_vn = btVector3(0, -5, 5) * share;
      }
    }
    scene.limits.source = 7.1;
    scene.limits.drop = 2;
    // What the water's momentum, all of it stopped in one step, is as a force
    scene.limits.force = freeMass(body) * fabric.capacity * (7.1 / scene.dt() + scene.gravity());
    scene.limits.calmFrom = 0;
    return underWeather(scene, body, cloth, Weather::Kind::wind, btVector3(0, 0, 0));
  };
  hardCase.duration = 6;
  return hardCase;
}

HardCase driesExactly() {
  HardCase hardCase = everywhere("dries_to_its_dry_mass", "masses", "saturated, in hot dry wind until nothing is left");
  hardCase.duration = 12;
  hardCase.build = [](CaseScene& scene) {
    btSoftBody& body = scene.add(hangingCloth(), 1000);
    wetcloth::WetCloth* const cloth = scene.wet(body);
    const auto dry = std::make_shared<std::vector<double>>(naive::massesOf(body));
    if (cloth != nullptr) {
      wetcloth::Drying::Parameters drying;
      drying.temperature = 60;
      drying.relativeHumidity = 0;
      drying.air = btVector3(0, 0, 30);
      drying.criticalSaturation = 0.01;
      drying.selfCooling = 1;
      cloth->add<wetcloth::Drying>(drying);
      cloth->add<wetcloth::Wind>({btVector3(0, 0, 0)});
      cloth->setSaturation(1);
    }
    scene.limits.drop = 0.1;
    scene.limits.force = freeMass(body) * scene.gravity();
    scene.limits.calmFrom = 0;
    Script script;
    script.finish = [=, &body](CaseMeter& meter) {
      if (cloth != nullptr) meter.compare("water left", cloth->ledger().held, 0);
      const std::vector<double> now = naive::massesOf(body);
      for (std::size_t i = 0; i < now.size(); ++i) {
        // One rounding for each of two reciprocals.
        if (now[i] > 0) meter.compare("mass drift", std::fabs(now[i] - (*dry)[i]), 2 * kRounding * (*dry)[i]);
      }
    };
    return script;
  };
  return hardCase;
}

/// Beside a twin that stays dry.
HardCase tenThousandCycles() {
  HardCase hardCase =
      everywhere("cycles_1e4", "masses", "10^4 times from dry to saturated and back, beside a dry twin");
  constexpr int atRest = 1000;  // steps at the end
  hardCase.steps = 20000 + atRest;
  hardCase.quickSteps = 2000 + atRest;
  hardCase.comparesAlways = false;
  hardCase.build = [](CaseScene& scene) {
    constexpr int nodes = 5;
    wetcloth::ClothPatch patch = hangingCloth(nodes);
    btSoftBody& body = scene.add(patch, 1000);
    patch.origin = btVector3(0, 0, 3);
    btSoftBody& twin = scene.add(patch, 1000);
    wetcloth::WetCloth* const cloth = scene.wet(body);
    wetcloth::WetCloth* const dryCloth = scene.wet(twin);
    for (wetcloth::WetCloth* const one : {cloth, dryCloth}) {
      if (one != nullptr) one->add<wetcloth::Wind>({btVector3(0, 0, 0)});
    }
    scene.limits.drop = 0.1;
    scene.limits.force = 2 * freeMass(body) * scene.gravity();
    scene.limits.calmFrom = 0;
    Script script;
    script.before = [=, &scene] {
      const bool isOver = scene.time() > scene.duration() - (atRest + 0.5) * scene.dt();
      if (cloth != nullptr) cloth->setSaturation(isOver ? 0 : (scene.steps() + 1) % 2);
    };
    script.finish = [&scene, &body, &twin](CaseMeter& meter) {
      const std::vector<double> now = naive::massesOf(body);
      const std::vector<double> dry = naive::massesOf(twin);
      for (int i = 0; i < body.m_nodes.size(); ++i) {
        const std::size_t at = static_cast<std::size_t>(i);
        if (dry[at] > 0) meter.compare("mass drift", std::fabs(now[at] - dry[at]), 2 * kRounding * dry[at]);
        const double apart = double((body.m_nodes[i].m_x + btVector3(0, 0, 3) - twin.m_nodes[i].m_x).length());
        // Of a height of 1 m: what each cloth's own swinging and stretching may still be.
        meter.compare("position drift", apart, 2e-3);
      }
      const std::vector<double>& rest = scene.cloths().front().restLengths;
      for (std::size_t k = 0; k < rest.size(); ++k) {
        const double drift = std::fabs(double(body.m_links[static_cast<int>(k)].m_rl) - rest[k]);
        meter.compare("rest length drift", drift, 2 * kRounding * rest[k]);
      }
    };
    return script;
  };
  return hardCase;
}

/// Free in space, without weight or air: what flies and takes up water that stood still must slow down.
HardCase momentum() {
  HardCase hardCase = everywhere("soaks_in_flight", "masses", "weightless, at 10 m/s through water that stands still");
  hardCase.isWeightless = true;
  hardCase.naiveMethod = "mass without momentum";
  hardCase.build = [](CaseScene& scene) {
    wetcloth::Fabric fabric = wetcloth::Fabric::highAbsorption();
    fabric.timeConstant = 0.5;
    btSoftBody& body = scene.add(uprightCloth(), 1000);
    wetcloth::WetCloth* const cloth = scene.wet(body, fabric);
    if (cloth != nullptr) cloth->add<wetcloth::Absorption>();
    const auto dry = std::make_shared<std::vector<double>>(naive::massesOf(body));
    const btVector3 velocity(6, 0, 8);
    for (int i = 0; i < body.m_nodes.size(); ++i) body.m_nodes[i].m_v = body.m_nodes[i].m_vn = velocity;
    const double mass = freeMass(body);
    scene.limits.source = 10;
    Script script;
    script.before = [=, &scene, &body] {
      if (!scene.isNaive()) return;
      const double saturation = 1 - std::exp(-scene.time() / fabric.timeConstant);
      naive::writeMassesWithoutMomentum(body, *dry, 1 + saturation * fabric.capacity);
    };
    script.observe = [&body, mass](CaseMeter& meter) {
      double energy = 0;
      double sum[3] = {0, 0, 0};
      for (int i = 0; i < body.m_nodes.size(); ++i) {
        const double one = 1 / double(body.m_nodes[i].m_im);
        energy += one * double(body.m_nodes[i].m_v.length2()) / 2;
        for (int axis = 0; axis < 3; ++axis) sum[axis] += one * double(body.m_nodes[i].m_v[axis]);
      }
      // Bullet's position-based worlds take velocities from positions of some 30 m in steps that are floats.
      const double rounding = sizeof(btScalar) == sizeof(double) ? 1e-6 : 2e-3;
      meter.compare("energy", energy, mass * 50 * (1 + rounding));
      const double error = std::hypot(sum[0] - 6 * mass, sum[1], sum[2] - 8 * mass);
      meter.compare("momentum", error, rounding * 10 * mass);
    };
    return script;
  };
  return hardCase;
}

}  // namespace

std::vector<HardCase> massCases() {
  return {uniformMass("1e-6", 1e-6),
          uniformMass("1e-3", 1e-3),
          uniformMass("10", 10),
          unlikeNeighbours(),
          oneWetNode(),
          atOnce("wet_in_one_step", "setMass in each step", naive::setMasses),
          atOnce("dry_in_one_step", "stale link constants", naive::writeMassesOnly),
          absorbedAtOnce(),
          driesExactly(),
          tenThousandCycles(),
          momentum()};
}

}  // namespace stability
