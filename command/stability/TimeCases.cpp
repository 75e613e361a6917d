// SPDX-License-Identifier: Zlib
#include "command/stability/CaseParts.h"
#include "command/stability/Cases.h"
#include "command/stability/NaiveMethods.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

// Applications that stutter, pause, change the rules, and take things away.
namespace stability {
namespace {

/// A hanging cloth in wind and rain, as all cases here have it.
struct WashingLine {
  explicit WashingLine(CaseScene& scene)
      : body(scene.add(hangingCloth(), 1000)),
        cloth(scene.wet(body)),
        weather(scene, body, cloth, Weather::Kind::rain, btVector3(1, 0, 5)) {
    double mass = 0;
    for (const double one : naive::massesOf(body)) mass += one;
    scene.limits.source = 5.1;
    scene.limits.drop = 2;
    scene.limits.force = 1.84 * mass * scene.gravity() + windForce(5.1);
    scene.limits.calmFrom = scene.duration() / 2;
  }

  btSoftBody& body;
  wetcloth::WetCloth* cloth;
  Weather weather;
};

HardCase onTheLine(std::string name, std::string about, std::function<void(CaseScene&, WashingLine&, Script&)> disturb,
                   double longestStep = 1, int springIterations = 4) {
  HardCase hardCase = everywhere(std::move(name), "time", std::move(about));
  hardCase.duration = 10;
  hardCase.build = [=](CaseScene& scene) {
    scene.springIterations = springIterations;
    auto line = std::make_shared<WashingLine>(scene);
    Script script;
    disturb(scene, *line, script);
    script.before = [line, disturbance = script.before] {
      line->weather.beforeStep();
      if (disturbance) disturbance();
    };
    // What one of its steps may do, where they are longer than the scene's own.
    scene.limits.source += scene.gravity() * scene.dt() * (longestStep - 1);
    return script;
  };
  return hardCase;
}

HardCase varyingSteps() {
  return onTheLine(
      "steps_that_vary", "each step is another, from a tenth of the scene's to three times as long",
      [](CaseScene& scene, WashingLine&, Script& script) {
        auto random = std::make_shared<Repeatable>(11);
        scene.limits.stretch *= 3;  // a step at full speed is three times as long
        script.advance = [=, &scene] {
          const double step = scene.dt() * 0.1 * std::pow(30, random->next());
          scene.bullet().stepSimulation(btScalar(step), 0);
        };
      },
      3, 16);
}

HardCase pauses() {
  return onTheLine("pauses", "steps of no length in between, in which nothing may move",
                   [](CaseScene& scene, WashingLine&, Script& script) {
                     script.advance = [&scene] {
                       for (int pause = scene.steps() % 3; pause > 0; --pause) scene.bullet().stepSimulation(0, 0);
                       scene.substep();
                     };
                   });
}

HardCase hitches() {
  return onTheLine("hitches_of_10_s", "every tenth frame takes 10 s, of which Bullet's cap lets 10 substeps through",
                   [](CaseScene& scene, WashingLine&, Script& script) {
                     script.advance = [&scene] {
                       const btScalar dt = btScalar(scene.dt());
                       scene.bullet().stepSimulation(scene.steps() % 10 == 9 ? btScalar(10) : dt, 10, dt);
                     };
                   });
}

/// btSoftBody's timescale, each of the five for ten steps.
HardCase timescales(const char* name, const char* about, std::array<double, 5> scales) {
  return onTheLine(
      name, about,
      [=](CaseScene& scene, WashingLine& line, Script& script) {
        scene.limits.stretch *= 2;
        script.before = [=, &scene, body = &line.body] {
          const bool isCalm = scene.time() >= scene.limits.calmFrom;
          body->m_cfg.timescale = isCalm ? 1 : btScalar(scales[static_cast<std::size_t>(scene.steps() / 10 % 5)]);
        };
      },
      2);
}

HardCase gravityChanges() {
  return onTheLine("gravity_off_and_reversed", "gravity is turned off and on its head every quarter of a second",
                   [](CaseScene& scene, WashingLine&, Script& script) {
                     script.before = [&scene] {
                       static constexpr double factors[4] = {1, 0, -1, 0};
                       const bool isCalm = scene.time() >= scene.limits.calmFrom;
                       const int phase = isCalm ? 0 : static_cast<int>(scene.time() * 4) % 4;
                       scene.setGravity(btVector3(0, btScalar(-9.81 * factors[phase]), 0));
                     };
                     scene.limits.drop = 2;
                   });
}

HardCase effectsComeAndGo() {
  return onTheLine("effects_added_and_removed", "effects are added and removed all the time, springs among them",
                   [](CaseScene& scene, WashingLine& line, Script& script) {
                     if (line.cloth == nullptr) return;
                     auto added = std::make_shared<std::vector<wetcloth::Effect*>>();
                     script.before = [=, &scene, cloth = line.cloth] {
                       if (scene.steps() % 7 == 0) {
                         for (wetcloth::Effect* const effect : *added) cloth->remove(*effect);
                         added->clear();
                       } else if (added->empty() && scene.time() < scene.limits.calmFrom) {
                         added->push_back(&cloth->add<wetcloth::Swelling>());
                         added->push_back(&cloth->add<wetcloth::WetStiffness>({0.8, 0.8, 2, 2}));
                         added->push_back(&cloth->add<wetcloth::Wind>({btVector3(0, 0, -5)}));
                         added->push_back(&cloth->add<wetcloth::Seepage>());
                       }
                     };
                   });
}

HardCase bodyLeaves() {
  return onTheLine("body_removed_and_put_back", "the body leaves the world for half of the time, again and again",
                   [](CaseScene& scene, WashingLine& line, Script& script) {
                     script.before = [&scene, body = &line.body] {
                       const bool isCalm = scene.time() >= scene.limits.calmFrom;
                       const bool shallBeIn = isCalm || scene.steps() / 5 % 2 == 0;
                       const bool isIn = scene.cloths().front().isInWorld;
                       if (isIn && !shallBeIn) scene.takeOut(*body);
                       if (!isIn && shallBeIn) scene.putBack(*body);
                     };
                   });
}

/// Other worlds of every kind, each with a wet cloth, that come and go.
class Neighbours {
 public:
  /// @param turn  in which order they go
  void live(const CaseScene& scene, int turn) {
    for (const World world : everyWorld()) {
      m_scenes.push_back(std::make_unique<CaseScene>(world, scene.way(), scene.dt()));
      WashingLine line(*m_scenes.back());
      m_scenes.back()->substep();
    }
    for (int k = 0; !m_scenes.empty(); ++k) {
      m_scenes.erase(m_scenes.begin() + (turn + k) % static_cast<int>(m_scenes.size()));
      for (const auto& other : m_scenes) other->substep();
    }
  }

 private:
  std::vector<std::unique_ptr<CaseScene>> m_scenes;
};

HardCase worldsInAnyOrder() {
  HardCase hardCase =
      onTheLine("worlds_in_any_order", "other worlds with wet cloths are made and destroyed in any order",
                [](CaseScene& scene, WashingLine&, Script& script) {
                  auto neighbours = std::make_shared<Neighbours>();
                  script.before = [=, &scene] {
                    const int every = std::max(1, static_cast<int>(scene.duration() / scene.dt() / 24));
                    if (scene.steps() % every == 0) neighbours->live(scene, scene.steps() / every);
                  };
                });
  return hardCase;
}

}  // namespace

std::vector<HardCase> timeCases() {
  return {varyingSteps(),
          pauses(),
          hitches(),
          timescales("time_scale_changes", "the body's time scale goes through 1, 1/2, 1/10, 2 and 1/4",
                     {1, 0.5, 0.1, 2, 0.25}),
          timescales("time_scale_0", "the body's time stands still now and then", {1, 0, 1, 0, 1}),
          gravityChanges(),
          effectsComeAndGo(),
          bodyLeaves(),
          worldsInAnyOrder()};
}

}  // namespace stability
