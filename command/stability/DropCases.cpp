// SPDX-License-Identifier: Zlib
#include "command/stability/CaseParts.h"
#include "command/stability/Cases.h"

#include <algorithm>
#include <memory>

// Drops that strike a light cloth hard.
namespace stability {
namespace {

wetcloth::Pour jet(double flow, double speed, double stop) {
  wetcloth::Pour pour;
  pour.position = btVector3(btScalar(0.5), btScalar(0.6), -1);
  pour.velocity = btVector3(0, 0, btScalar(speed));
  pour.flow = flow;
  pour.mouthRadius = 0.3;
  pour.stop = stop;
  return pour;
}

/// It strikes for half of the time; then the cloth may come to rest.
HardCase struckBy(double flow, double speed, int mostDrops, std::string name, std::string about) {
  HardCase hardCase = everywhere(std::move(name), "drops", std::move(about));
  hardCase.duration = 6;
  hardCase.build = [=](CaseScene& scene) {
    const double capacity = 0.84 * 0.15;  // of a square metre of cotton [kg]
    scene.limits.calmFrom = scene.duration() / 2;
    scene.limits.source = speed;
    scene.limits.drop = 2;
    scene.limits.force = (0.15 + capacity) * scene.gravity() + flow * speed;
    btSoftBody& body = scene.add(hangingCloth(), std::max(1000., scene.limits.force));
    wetcloth::WetCloth* const wet = scene.wet(body);
    const auto weather =
        std::make_shared<Weather>(scene, body, wet, Weather::Kind::wind, btVector3(0, 0, 0), /*skinFriction*/ 0.01);
    std::shared_ptr<wetcloth::Drops> drops;
    if (wet != nullptr) {
      wet->add<wetcloth::Dripping>();
      wetcloth::Drops::Parameters parameters;
      parameters.mostDrops = mostDrops;
      parameters.longestFlight = 1;
      drops = std::make_shared<wetcloth::Drops>(*scene.wetWorld(), parameters);
      drops->add(jet(flow, speed, scene.limits.calmFrom));
    }
    Script script;
    script.before = [weather, drops] { weather->beforeStep(); };
    return script;
  };
  return hardCase;
}

}  // namespace

std::vector<HardCase> dropCases() {
  return {struckBy(0.1, 20, 2000, "drops_20_m_s", "0.1 kg/s of drops strike a hanging cloth at 20 m/s"),
          struckBy(1, 10, 50, "drops_merged", "1 kg/s of drops at 10 m/s, and no more than 50 at a time")};
}

}  // namespace stability
