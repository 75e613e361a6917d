// SPDX-License-Identifier: Zlib
#include "command/stability/CaseRun.h"

#include "command/stability/CaseScene.h"
#include "command/stability/SceneMeter.h"

#include <algorithm>
#include <cmath>

namespace stability {
namespace {

constexpr int kFewestSteps = 60;  // long enough to blow up at the longest step, too

int stepsOf(const HardCase& hardCase, double dt, Effort effort) {
  const bool isQuick = effort == Effort::quick;
  if (hardCase.steps > 0) return isQuick && hardCase.quickSteps > 0 ? hardCase.quickSteps : hardCase.steps;
  const double duration = isQuick && hardCase.quickDuration > 0 ? hardCase.quickDuration : hardCase.duration;
  return std::max(static_cast<int>(std::ceil(duration / dt - 1e-9)), kFewestSteps);
}

bool advance(CaseScene& scene, const Script& script, SceneMeter& sceneMeter, CaseMeter& meter) {
  if (script.before) script.before();
  if (script.advance) {
    script.advance();
  } else {
    scene.substep();
  }
  scene.countStep();
  if (!sceneMeter.observe()) return false;
  if (script.observe) script.observe(meter);
  return true;
}

}  // namespace

CaseMeter runCase(const HardCase& hardCase, World world, Way way, double dt, Effort effort) {
  CaseMeter meter;
  if (hardCase.compute) {
    hardCase.compute(way, meter);
    return meter;
  }
  CaseScene scene(world, way, dt, btVector3(0, hardCase.isWeightless ? 0 : btScalar(-9.81), 0));
  const int steps = stepsOf(hardCase, dt, effort);
  scene.setDuration(steps * dt);
  const Script script = hardCase.build(scene);
  scene.begin();
  SceneMeter sceneMeter(scene, meter);
  for (int i = 0; i < steps; ++i) {
    if (advance(scene, script, sceneMeter, meter)) continue;
    sceneMeter.giveUp();
    return meter;
  }
  sceneMeter.finish();
  if (script.finish) script.finish(meter);
  return meter;
}

// Where Bullet alone, dry or wet, goes wrong in the same way, nothing that we add can put it right.
CaseResult::Verdict CaseResult::verdict() const {
  if (ours.holds()) return Verdict::holds;
  if (!plainBullet) return Verdict::fails;
  const bool isFinite = plainBullet->marginOf("finite") <= 1;
  for (const CaseMeter::Margin& margin : ours.margins()) {
    if (margin.ratio > 1 && isFinite && !(plainBullet->marginOf(margin.bound) > 1)) return Verdict::fails;
  }
  return Verdict::bulletFails;
}

CaseResult tryCase(const HardCase& hardCase, World world, double dt, Effort effort, Comparisons comparisons) {
  CaseResult result{&hardCase, world, dt, runCase(hardCase, world, Way::ours, dt, effort), {}, {}};
  const bool comparesAlways = hardCase.comparesAlways && comparisons == Comparisons::all;
  if (!hardCase.compute && (comparesAlways || !result.ours.holds())) {
    result.plainBullet = runCase(hardCase, world, Way::plainBullet, dt, effort);
    if (result.verdict() == CaseResult::Verdict::fails) {
      result.plainBullet = runCase(hardCase, world, Way::plainBulletWet, dt, effort);
    }
  }
  if (comparisons == Comparisons::all && !hardCase.naiveMethod.empty()) {
    result.naiveMethod = runCase(hardCase, world, Way::naive, dt, effort);
  }
  return result;
}

const char* nameOf(CaseResult::Verdict verdict) {
  switch (verdict) {
    case CaseResult::Verdict::holds: return "holds";
    case CaseResult::Verdict::fails: return "fails";
    case CaseResult::Verdict::bulletFails: break;
  }
  return "bullet_fails";
}

}  // namespace stability
