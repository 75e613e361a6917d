// SPDX-License-Identifier: Zlib
#include "command/stability/CaseParts.h"
#include "command/stability/Cases.h"
#include "command/stability/NaiveMethods.h"

#include <cmath>
#include <memory>

// An hour on the line.
namespace stability {
namespace {

/// One washing day: 5 minutes of rain, 30 s of wringing and shaking, the rest in the wind, and again.
constexpr double kCycle = 1200;  // [s]
constexpr double kRain = 300;
constexpr double kShake = 330;

class Laundry {
 public:
  Laundry(CaseScene& scene, btSoftBody& body) : m_scene(scene), m_body(body), m_cloth(scene.wet(body)) {
    for (int i = 0; i < body.m_nodes.size(); ++i) m_starts.push_back(body.m_nodes[i].m_x);
    if (m_cloth == nullptr) return;
    wetcloth::Absorption::Parameters rain;
    rain.waterVelocity = btVector3(0, -5, 0);
    m_rain = &m_cloth->add<wetcloth::Absorption>(rain);
    m_cloth->add<wetcloth::Diffusion>();
    m_dripping = &m_cloth->add<wetcloth::Dripping>();
    wetcloth::Drying::Parameters summer;
    summer.temperature = 35;
    summer.relativeHumidity = 0.2;
    m_drying = &m_cloth->add<wetcloth::Drying>(summer);
    m_wind = &m_cloth->add<wetcloth::Wind>({btVector3(0, 0, 0)});
  }

  void beforeStep() {
    const double share = m_scene.time() / m_scene.duration();
    const double time = std::fmod(3 * share, 1) * kCycle;  // three cycles, however long the run is
    const Phase phase = time < kRain ? Phase::rain : time < kShake ? Phase::shake : Phase::dry;
    if (phase != m_phase) turnTo(phase);
    shake(phase == Phase::shake ? 0.1 * std::sin(2 * 3.14159265 * 2 * m_scene.time()) : 0);
  }

 private:
  enum class Phase { none, rain, shake, dry };

  void turnTo(Phase phase) {
    m_phase = phase;
    if (m_cloth == nullptr) return;
    adjust(*m_rain, [&](auto& p) { p.exposure = phase == Phase::rain ? 1.0 : 0.0; });
    adjust(*m_dripping, [&](auto& p) { p.holdingSaturation = phase == Phase::shake ? 0.3 : 0.6; });
    const btVector3 air = phase == Phase::dry ? btVector3(2, 0, 6) : btVector3(0, 0, 0);
    adjust(*m_wind, [&](auto& p) { p.velocity = air; });
    adjust(*m_drying, [&](auto& p) { p.air = air; });
  }
  void shake(double offset) {
    for (int i = 0; i < m_body.m_nodes.size(); ++i) {
      if (m_body.m_nodes[i].m_im > 0) continue;
      m_body.m_nodes[i].m_x = m_starts[static_cast<std::size_t>(i)] + btVector3(0, btScalar(offset), 0);
    }
  }

  CaseScene& m_scene;
  btSoftBody& m_body;
  wetcloth::WetCloth* m_cloth;
  std::vector<btVector3> m_starts;
  Phase m_phase = Phase::none;
  wetcloth::Absorption* m_rain = nullptr;
  wetcloth::Dripping* m_dripping = nullptr;
  wetcloth::Drying* m_drying = nullptr;
  wetcloth::Wind* m_wind = nullptr;
};

HardCase laundry(const char* name, const char* about, double duration, std::vector<double> steps) {
  HardCase hardCase = everywhere(name, "laundry", about);
  hardCase.duration = duration;
  hardCase.quickDuration = 60;
  hardCase.comparesAlways = false;
  hardCase.stepSizes = std::move(steps);
  hardCase.build = [](CaseScene& scene) {
    btSoftBody& body = scene.add(hangingCloth(5), 1000);
    auto day = std::make_shared<Laundry>(scene, body);
    double mass = 0;
    for (const double one : naive::massesOf(body)) mass += one;
    scene.limits.source = 6.4;
    scene.limits.drop = 2.2;
    scene.limits.force = 1.84 * mass * (scene.gravity() + 0.1 * 160) + windForce(6.4);
    Script script;
    script.before = [day] { day->beforeStep(); };
    return script;
  };
  return hardCase;
}

}  // namespace

std::vector<HardCase> laundryCases() {
  return {
      laundry("laundry_2_minutes", "washed, shaken and dried three times in 2 minutes", 120, {1. / 1000, 1. / 240}),
      laundry("laundry_1_hour", "washed, shaken and dried three times in an hour", 3600, {1. / 60, 1. / 30, 1. / 10})};
}

}  // namespace stability
