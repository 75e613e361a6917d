// SPDX-License-Identifier: Zlib
#include "command/stability/CaseParts.h"
#include "command/stability/Cases.h"
#include "command/stability/NaiveMethods.h"

#include <memory>
#include <utility>

// HookeSprings, which hold the cloth in place of Bullet's own links in every world, at any stiffness and step.
namespace stability {
namespace {

HardCase hooke(const char* name, const char* about, double stiffness) {
  HardCase hardCase = everywhere(name, "springs", about);
  hardCase.duration = 6;
  hardCase.build = [=](CaseScene& scene) {
    btSoftBody& body = scene.add(hangingCloth(), stiffness);
    double mass = 0;
    for (const double one : naive::massesOf(body)) mass += one;
    wetcloth::WetCloth* const cloth = scene.wet(body);
    if (cloth != nullptr && !isDeformable(scene.world())) {
      wetcloth::HookeSprings::Parameters springs;
      springs.stiffness = stiffness;
      springs.bendingStiffness = 0.01 * stiffness;
      cloth->add<wetcloth::HookeSprings>(springs);
    }
    scene.limits.source = 5.1;
    scene.limits.force = 1.84 * mass * scene.gravity() + windForce(5.1);
    // Soft springs let the whole cloth sink.
    scene.limits.drop = 2 + 2 * scene.limits.force / stiffness;
    if (!isDeformable(scene.world())) scene.limits.stretch += scene.limits.force / stiffness * kNodes;
    return underWeather(scene, body, cloth, Weather::Kind::rain, btVector3(1, 0, 5));
  };
  return hardCase;
}

}  // namespace

std::vector<HardCase> springCases() {
  return {hooke("springs_of_10_N_m", "springs so soft that the cloth hangs as rubber", 10),
          hooke("springs_of_1e6_N_m", "springs as stiff as canvas", 1e6)};
}

}  // namespace stability
