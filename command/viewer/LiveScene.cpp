// SPDX-License-Identifier: Zlib
#include "command/viewer/LiveScene.h"

#include "command/cli/Errors.h"
#include "command/scene/SoundState.h"

#include "bullet_wetcloth/Require.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <stdexcept>
#include <utility>

namespace viewer {
namespace {

using wetcloth::Absorption;
using wetcloth::Rain;
using wetcloth::WetCloth;
using wetcloth::Wind;

/// Steps at most for so long before the next picture is shown [s].
constexpr double mostTimeInSteps = 0.1;

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

template <class E, class Action>
void forEach(const command::SceneWorld& world, Action action) {
  for (WetCloth* cloth : world.cloths()) {
    cloth->forEach<E>([&](E& effect) { action(effect, *cloth); });
  }
}

bool varies(const wetcloth::Exposure& exposure) { return exposure.isFunction() || exposure.isPerNode(); }

void requireInteger(const char* field, int value, int most) {
  if (value < 1 || value > most) wetcloth::rejectValue(field, value, "1 to " + std::to_string(most));
}

/// What WetCloth::push() does, for a body that the library does not know.
Grip::Push pushInPlainBullet(bool isDeformable) {
  return [isDeformable](btSoftBody::Node& node, const btVector3& change) {
    if (node.m_im == 0) return;
    node.m_v += change;
    if (isDeformable) node.m_vn += change;
  };
}

}  // namespace

LiveScene::LiveScene(command::Scene scene, const command::EffectCatalogue& catalogue)
    : m_original(std::move(scene)), m_effects(m_original, catalogue), m_scene(m_original) {
  build();
  m_sampler = std::make_unique<command::FrameSampler>(*m_wet);
  note();
}

// --- time -----------------------------------------------------------------------------------------------------------

void LiveScene::advance(double seconds) {
  if (m_isPaused || !(seconds > 0) || !std::isfinite(seconds)) return;
  m_timeLeft += seconds * m_timeScale;
  const auto start = std::chrono::steady_clock::now();
  while (m_timeLeft >= m_scene.step && m_failure.empty()) {
    step();
    m_timeLeft -= m_scene.step;
    if (secondsSince(start) > mostTimeInSteps) m_timeLeft = std::min(m_timeLeft, m_scene.step / 2);
  }
}

void LiveScene::step() {
  if (!m_failure.empty()) return;
  m_effects.clock().beginStep();
  m_wet->step([this](btScalar dt) { pull(Side::wet, dt); });
  m_effects.clock().endStep();
  if (m_plain) m_plain->step([this](btScalar dt) { pull(Side::plainBullet, dt); });
  ++m_steps;
  note();
  const double windSet = m_levers.wind ? static_cast<double>(m_levers.wind->length()) : 0;
  if (const auto blowUp = command::describeBlowUp(*m_wet, windSet + Grip::fastest)) {
    m_failure = *blowUp + "; then reset";
  }
}

void LiveScene::pull(Side side, btScalar dt) {
  if (m_grip && m_grippedSide == side) m_grip->pull(dt);
}

void LiveScene::note() {
  m_water.add(waterHeld());
  m_saturation.add(meanSaturation());
}

void LiveScene::reset() {
  release();
  m_notice.clear();
  const bool compared = isCompared();
  m_plain.reset();
  m_wet.reset();
  buildAgain();
  if (compared) buildPlain();
  m_effects.clock().clear();
  m_water.clear();
  m_saturation.clear();
  m_timeLeft = 0;
  m_steps = 0;
  m_failure.clear();
  note();
}

void LiveScene::restore() {
  forgetSettings();
  reset();
}

void LiveScene::buildAgain() {
  try {
    build();
  } catch (const command::InputError& refused) {
    forgetSettings();
    build();  // as it was built at first
    m_notice = refused.what();
  }
}

void LiveScene::forgetSettings() {
  m_effects.restore();
  m_levers = {};
  m_scene.substeps = m_original.substeps;
  m_scene.iterations = m_original.iterations;
}

void LiveScene::setTimeScale(double scale) {
  if (!(scale > 0 && scale <= 4)) wetcloth::rejectValue("timeScale", scale, "in (0, 4]");
  m_timeScale = scale;
}

command::Scene LiveScene::equippedScene() {
  command::Scene scene = m_original;
  scene.substeps = m_scene.substeps;
  scene.iterations = m_scene.iterations;
  m_effects.equip(scene);
  command::choose(solver(), scene.clothSolver);
  if (m_levers.fabric.empty()) return scene;
  for (command::ClothScene& cloth : scene.cloths) {
    wetcloth::Fabric fabric = wetcloth::Fabric::byName(m_levers.fabric);
    fabric.dryColour = cloth.fabric.dryColour;
    fabric.dryRoughness = cloth.fabric.dryRoughness;
    cloth.makeOf(fabric);
  }
  return scene;
}

void LiveScene::build() {
  m_scene = equippedScene();
  m_wet = std::make_unique<command::SceneWorld>(m_scene);
  m_fabricInUse = m_levers.fabric;
  pullLevers();
}

void LiveScene::buildPlain() {
  m_plain = std::make_unique<command::SceneWorld>(m_scene, command::SceneWorld::Kind::plainBullet);
}

// --- effects --------------------------------------------------------------------------------------------------------

bool LiveScene::isOn(const std::string& effect) const {
  const auto& switches = m_effects.list();
  return std::any_of(switches.begin(), switches.end(),
                     [&](const auto& each) { return each.key == effect && each.isOn; });
}

void LiveScene::turnEffect(std::size_t index, bool on) {
  m_effects.turn(index, on, *m_wet);
  if (on) pullLevers();
}

double LiveScene::libraryMicroseconds() const {
  double sum = m_effects.commitMicroseconds();
  for (std::size_t i = 0; i < m_effects.list().size(); ++i) sum += m_effects.microseconds(i);
  return sum;
}

double LiveScene::bulletMicroseconds() const {
  return std::max(0.0, m_effects.clock().stepMicroseconds() - libraryMicroseconds());
}

// --- levers ---------------------------------------------------------------------------------------------------------

void LiveScene::pullLevers() {
  if (m_levers.wind) {
    forEach<Wind>(*m_wet, [&](Wind& wind, WetCloth&) { adjust(wind, [&](auto& p) { p.velocity = *m_levers.wind; }); });
  }
  if (m_levers.exposure) {
    forEach<Absorption>(*m_wet, [&](Absorption& absorption, WetCloth&) {
      adjust(absorption, [&](auto& p) { p.exposure = *m_levers.exposure; });
    });
  }
  forEach<Rain>(*m_wet, [&](Rain& rain, WetCloth&) {
    if (m_levers.rainFlux) adjust(rain, [&](auto& p) { p.flux = *m_levers.rainFlux; });
    if (m_levers.rainDirection) adjust(rain, [&](auto& p) { p.direction = *m_levers.rainDirection; });
  });
}

void LiveScene::setWind(const btVector3& velocity) {
  Wind::Parameters parameters;
  parameters.velocity = velocity;
  static_cast<void>(Wind(parameters));  // checks it, also where no cloth has wind
  m_levers.wind = velocity;
  pullLevers();
}

btVector3 LiveScene::wind() const {
  if (m_levers.wind) return *m_levers.wind;
  btVector3 velocity(0, 0, 0);
  forEach<Wind>(*m_wet, [&](const Wind& wind, const WetCloth& cloth) {
    velocity = wind.parameters().velocity.at((cloth.body().m_bounds[0] + cloth.body().m_bounds[1]) / 2, time());
  });
  return velocity;
}

bool LiveScene::windVaries() const {
  bool varies = false;
  forEach<Wind>(*m_wet,
                [&](const Wind& wind, const WetCloth&) { varies = varies || wind.parameters().velocity.isFunction(); });
  return varies;
}

void LiveScene::setExposure(double exposure) {
  Absorption::Parameters parameters;
  parameters.exposure = exposure;
  static_cast<void>(Absorption(parameters));
  m_levers.exposure = exposure;
  pullLevers();
}

double LiveScene::exposure() const {
  double value = m_levers.exposure.value_or(1);
  const btVector3 anywhere(0, 0, 0);
  forEach<Absorption>(*m_wet, [&](const Absorption& absorption, const WetCloth&) {
    if (!varies(absorption.parameters().exposure))
      value = absorption.parameters().exposure.at(0, anywhere, anywhere, 0);
  });
  return value;
}

bool LiveScene::exposureVaries() const {
  bool itDoes = false;
  forEach<Absorption>(*m_wet, [&](const Absorption& absorption, const WetCloth&) {
    itDoes = itDoes || varies(absorption.parameters().exposure);
  });
  return itDoes;
}

void LiveScene::setRainFlux(double flux) {
  Rain::Parameters parameters;
  parameters.flux = flux;
  static_cast<void>(Rain(parameters));
  m_levers.rainFlux = flux;
  pullLevers();
}

double LiveScene::rainFlux() const {
  double flux = m_levers.rainFlux.value_or(0);
  forEach<Rain>(*m_wet, [&](const Rain& rain, const WetCloth&) { flux = rain.parameters().flux; });
  return flux;
}

void LiveScene::setRainDirection(const btVector3& direction) {
  Rain::Parameters parameters;
  parameters.direction = direction;
  static_cast<void>(Rain(parameters));
  m_levers.rainDirection = direction;
  pullLevers();
}

btVector3 LiveScene::rainDirection() const {
  btVector3 direction = m_levers.rainDirection.value_or(-m_scene.up());
  forEach<Rain>(*m_wet, [&](const Rain& rain, const WetCloth&) { direction = rain.parameters().direction; });
  return direction;
}

void LiveScene::setFabric(const std::string& preset) {
  if (!preset.empty()) wetcloth::Fabric::byName(preset);  // throws for a name that it does not know
  m_levers.fabric = preset;
}

void LiveScene::setSolver(command::SolverKind solver) {
  if (solver == command::SolverKind::wetcloth && m_scene.world == command::WorldKind::deformable) {
    throw std::invalid_argument("solver = wetcloth: must be bullet in the world deformable");
  }
  m_levers.solver = solver;
}

bool LiveScene::waitsForReset() const {
  const auto& switches = m_effects.list();
  return m_scene.solver() != solver() || m_fabricInUse != m_levers.fabric ||
         std::any_of(switches.begin(), switches.end(), [](const auto& each) { return each.waitsForReset; });
}

void LiveScene::setSubsteps(int substeps) {
  requireInteger("substeps", substeps, 1000);
  m_scene.substeps = substeps;
}

void LiveScene::setIterations(int iterations) {
  requireInteger("iterations", iterations, 10000);
  m_scene.iterations = iterations;
  m_wet->setIterations(iterations);
  if (m_plain) m_plain->setIterations(iterations);
}

// --- comparison and hand --------------------------------------------------------------------------------------------

void LiveScene::setCompared(bool compared) {
  if (compared == isCompared()) return;
  if (!compared) {
    if (m_grippedSide == Side::plainBullet) release();
    m_plain.reset();
    return;
  }
  buildPlain();
  if (m_steps > 0) m_plain->continueFrom(*m_wet);
}

bool LiveScene::grab(const Ray& ray, Side side) {
  release();
  if (side == Side::plainBullet && !m_plain) return false;
  const auto hit = pickCloth(ray, scenery(), cloths(), frame(side));
  if (!hit) return false;
  const auto cloth = static_cast<std::size_t>(hit->cloth);
  m_grippedSide = side;
  if (side == Side::plainBullet) {
    m_grip.emplace(*m_plain->bodies()[cloth], hit->node,
                   pushInPlainBullet(m_scene.world == command::WorldKind::deformable));
    return true;
  }
  WetCloth* const wet = m_wet->cloths()[cloth];
  m_grip.emplace(wet->body(), hit->node,
                 [wet](btSoftBody::Node& node, const btVector3& change) { wet->push(node, change); });
  return true;
}

void LiveScene::dragTo(const btVector3& goal) {
  if (m_grip && std::isfinite(goal.length2())) m_grip->moveTo(goal);
}

// --- what there is to see -------------------------------------------------------------------------------------------

const pictures::Frame& LiveScene::frame(Side side) {
  const command::SceneWorld& world = side == Side::plainBullet && m_plain ? *m_plain : *m_wet;
  pictures::Frame& frame = m_frames[side == Side::plainBullet ? 1 : 0];
  m_sampler->take(world, world.time(), frame);
  return frame;
}

double LiveScene::waterHeld() const {
  double held = 0;
  for (const WetCloth* cloth : m_wet->cloths()) held += cloth->ledger().held;
  return held;
}

double LiveScene::meanSaturation() const {
  double capacity = 0;
  for (const WetCloth* cloth : m_wet->cloths()) {
    for (int i = 0; i < cloth->nodeCount(); ++i) capacity += cloth->capacity(i);
  }
  return capacity > 0 ? waterHeld() / capacity : 0;
}

}  // namespace viewer
