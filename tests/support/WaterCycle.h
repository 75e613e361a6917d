// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/Materials.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace wetcloth_test {

/// Every effect of the water cycle at once, with parameters that a test makes up.
namespace water_cycle {

struct Choice {
  std::vector<std::string> names;                         ///< of the effects, as scenes spell them
  std::function<double(double low, double high)> number;  ///< both > 0
  std::function<double()> fraction;                       ///< in [0, 1]
  std::function<btVector3(double size)> vector;           ///< each component in [-size, size]
};

inline const std::vector<std::string>& names() {
  static const std::vector<std::string> all{"absorption",      "immersion",     "rain",         "splash",
                                            "contact_wetting", "diffusion",     "seepage",      "dripping",
                                            "drying",          "wet_stiffness", "swelling",     "wind",
                                            "water_drag",      "cling",         "wet_friction", "hooke_springs"};
  return all;
}

/// The collision flags by which each world finds rigid bodies node by node.
inline void letTouch(BulletWorld& bullet, btSoftBody& body) {
  using Flags = btSoftBody::fCollision;
  if (bullet.isDeformable()) body.m_cfg.collisions = Flags::SDF_RD | Flags::SDF_RDN;
}

/// Bullet's water surface at this height.
inline void giveWater(btSoftBodyWorldInfo& info, btScalar level) {
  info.water_normal = btVector3(0, 1, 0);
  info.water_offset = -level;
  info.water_density = 1000;
}

inline btVector3 nonZero(const btVector3& v) { return v.length2() > btScalar(1e-6) ? v : btVector3(0, -1, 0); }

inline void addSource(wetcloth::WetCloth& cloth, const std::string& name, const Choice& choice) {
  if (name == "absorption") {
    wetcloth::Absorption::Parameters parameters;
    parameters.exposure = choice.fraction();
    parameters.waterVelocity = choice.vector(5);
    cloth.add<wetcloth::Absorption>(parameters);
  } else if (name == "immersion") {
    cloth.add<wetcloth::Immersion>();
  } else if (name == "rain") {
    cloth.add<wetcloth::Rain>(
        {nonZero(choice.vector(1)), choice.number(1e-5, 100), choice.number(0.1, 20), choice.fraction() < 0.5});
  } else if (name == "splash") {
    wetcloth::Splash::Parameters parameters;
    if (choice.fraction() < 0.5) {
      parameters.region = wetcloth::Splash::Cone{choice.vector(1), choice.number(0.01, 1.5), choice.number(0.1, 10)};
    } else {
      parameters.region = wetcloth::Splash::Sphere{choice.vector(0.5), choice.number(0.01, 2)};
    }
    parameters.velocity = nonZero(choice.vector(10));
    parameters.flux = choice.number(1e-4, 100);
    cloth.add<wetcloth::Splash>(parameters);
  } else if (name == "contact_wetting") {
    cloth.add<wetcloth::ContactWetting>();
  }
}

inline void addTransportOrLoss(wetcloth::WetCloth& cloth, const std::string& name, const Choice& choice) {
  if (name == "diffusion") {
    using Method = wetcloth::Diffusion::Method;
    wetcloth::Diffusion::Parameters parameters;
    parameters.warpDiffusivity = choice.number(1e-9, 1);
    parameters.weftDiffusivity = choice.number(1e-9, 1);
    parameters.exponent = choice.fraction() < 0.3 ? 0 : choice.number(0.1, 6);
    parameters.warp = nonZero(choice.vector(1));
    const double method = choice.fraction();
    parameters.method = method < 0.4   ? Method::factored
                        : method < 0.7 ? Method::conjugateGradients
                                       : Method::explicitSubsteps;
    cloth.add<wetcloth::Diffusion>(parameters);
  } else if (name == "seepage") {
    cloth.add<wetcloth::Seepage>({choice.number(1e-6, 10), choice.number(1, 10)});
  } else if (name == "dripping") {
    cloth.add<wetcloth::Dripping>(
        {choice.fraction(), choice.number(1e-3, 100), choice.number(1e-9, 1e-3), choice.fraction(), 0, nullptr});
  } else if (name == "drying") {
    wetcloth::Drying::Parameters parameters;
    parameters.temperature = 60 * choice.fraction();
    parameters.relativeHumidity = choice.fraction();
    parameters.air = choice.vector(30);
    parameters.criticalSaturation = choice.number(1e-3, 1);
    parameters.exposure = choice.fraction();
    cloth.add<wetcloth::Drying>(parameters);
  }
}

inline void addMechanics(wetcloth::WetCloth& cloth, const std::string& name, const Choice& choice) {
  if (name == "wet_stiffness") {
    const bool hasSprings = !cloth.effects().empty() && cloth.effects().back().name() == std::string("HookeSprings");
    const bool mayChange = hasSprings || !cloth.isInDeformableWorld();
    cloth.add<wetcloth::WetStiffness>({mayChange ? choice.number(0.05, 20) : 1, mayChange ? choice.number(0.05, 20) : 1,
                                       choice.number(0.01, 1000), choice.number(0.01, 1000)});
  } else if (name == "swelling") {
    cloth.add<wetcloth::Swelling>({0.8 * (choice.fraction() - 0.5)});
  } else if (name == "wind") {
    cloth.add<wetcloth::Wind>({choice.vector(50)});
  } else if (name == "water_drag") {
    wetcloth::WaterDrag::Parameters parameters;
    parameters.dragCoefficient = choice.number(0.01, 10);
    parameters.skinFriction = choice.fraction();
    parameters.fibreDensity = choice.number(300, 3000);
    cloth.add<wetcloth::WaterDrag>(parameters);
  } else if (name == "cling") {
    cloth.add<wetcloth::Cling>();
  } else if (name == "wet_friction") {
    cloth.add<wetcloth::WetFriction>();
  } else if (name == "hooke_springs") {
    cloth.add<wetcloth::HookeSprings>(springsOf(choice.number(1, 1000), choice.number(0.01, 10)));
  }
}

/// Springs first: what changes them wants to find them.
inline void add(wetcloth::WetCloth& cloth, const Choice& choice) {
  const auto isAsked = [&](const char* name) {
    return std::find(choice.names.begin(), choice.names.end(), name) != choice.names.end();
  };
  if (isAsked("hooke_springs")) addMechanics(cloth, "hooke_springs", choice);
  for (const std::string& name : names()) {
    if (!isAsked(name.c_str()) || name == "hooke_springs") continue;
    addSource(cloth, name, choice);
    addTransportOrLoss(cloth, name, choice);
    addMechanics(cloth, name, choice);
  }
}

/// What is wrong with the cloth's state; "" when nothing is.
inline std::string faultOf(const wetcloth::WetCloth& cloth) {
  if (!isFinite(cloth.body())) return "a position or velocity is not finite";
  double held = 0;
  for (int i = 0; i < cloth.nodeCount(); ++i) {
    const std::string node = "node " + std::to_string(i) + " holds " + std::to_string(cloth.held(i)) + " kg of " +
                             std::to_string(cloth.capacity(i));
    if (!(cloth.held(i) >= 0)) return node;
    // Capacity times a share is rounded.
    if (!(cloth.held(i) <= cloth.capacity(i) * (1 + 1e-14))) return node;
    held += cloth.held(i);
  }
  const wetcloth::Ledger ledger = cloth.ledger();
  const double turnover = std::fabs(ledger.initial) + ledger.absorbed + ledger.dripped + ledger.evaporated;
  if (!(std::fabs(ledger.imbalance()) <= 1e-12 * turnover)) {
    return "the ledger is off by " + std::to_string(ledger.imbalance() / turnover) + " of what it booked";
  }
  if (!(std::fabs(ledger.held - held) <= 1e-12 * turnover)) return "the ledger holds another sum than the nodes";
  return "";
}

}  // namespace water_cycle
}  // namespace wetcloth_test
