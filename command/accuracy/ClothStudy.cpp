// SPDX-License-Identifier: Zlib
#include "command/accuracy/ConvergenceOrder.h"
#include "command/accuracy/Studies.h"
#include "command/accuracy/SwingingCloth.h"

#include <cmath>
#include <string>
#include <utility>

namespace accuracy {
namespace {

using Kind = ClothSolver::Kind;

constexpr double sagDuration = 2;
constexpr double swingDuration = 4.5;     // two and a half periods
constexpr double swingAngle = 0.3490659;  // 20 degrees [rad]
constexpr double referenceStep = 5e-5;    // a twentieth of what is stable [s]

std::string nameOf(Kind kind) {
  switch (kind) {
    case Kind::links: return "Bullet's links";
    case Kind::smallSteps: return "ClothSolver";
    case Kind::hookeSprings: return "HookeSprings";
    case Kind::deformableExplicit: return "deformable, explicit";
    case Kind::deformableImplicit: break;
  }
  return "deformable, implicit";
}

std::vector<ClothSolver> solvers(const Effort& effort) {
  if (effort.isQuick) {
    return {{Kind::links, 1, 10},      {Kind::links, 4, 10},       {Kind::links, 4, 50},
            {Kind::smallSteps, 1, 10}, {Kind::hookeSprings, 4, 4}, {Kind::deformableImplicit, 4, 10}};
  }
  std::vector<ClothSolver> all;
  for (const int substeps : {1, 2, 4, 8, 16}) {
    for (const int iterations : {1, 2, 5, 10, 20, 50, 100, 200}) {
      // Beyond that nothing gets better, and it takes minutes.
      if (substeps * iterations <= 400) all.push_back({Kind::links, substeps, iterations});
    }
    for (const int iterations : {3, 4, 8, 16}) all.push_back({Kind::hookeSprings, substeps, iterations});
    all.push_back({Kind::deformableImplicit, substeps, 10});
    all.push_back({Kind::deformableExplicit, substeps, 10});
  }
  all.push_back({Kind::deformableExplicit, 64, 10});
  for (const int smallSteps : {2, 4, 8, 10, 16, 20, 40, 80, 160, 320}) all.push_back({Kind::smallSteps, 1, smallSteps});
  return all;
}

void addSettings(Plan& plan, const Effort& effort, double duration,
                 const std::function<Outcome(const ClothSolver&)>& run) {
  for (const ClothSolver& solver : solvers(effort)) {
    Setting setting;
    setting.method = nameOf(solver.kind);
    setting.label = std::to_string(solver.substeps) + (solver.substeps == 1 ? " substep" : " substeps");
    const std::string iterations =
        std::to_string(solver.iterations) + (solver.iterations == 1 ? " iteration" : " iterations");
    if (solver.kind == Kind::links) {
      setting.method += ", " + setting.label;
      setting.label = iterations;
    }
    if (solver.kind == Kind::smallSteps) setting.label = std::to_string(solver.iterations) + " small steps";
    if (solver.kind == Kind::hookeSprings) setting.method += ", " + iterations;
    const bool isCounted = solver.kind == Kind::links || solver.kind == Kind::smallSteps;
    setting.knob = isCounted ? 1. / solver.iterations : solver.substep();
    setting.nodes = SwingingCloth::side * SwingingCloth::side;
    setting.steps = 60 * duration * solver.substeps;
    setting.simulatedSeconds = duration;
    setting.substep = solver.substep();
    if (solver.kind != Kind::hookeSprings) setting.iterations = solver.iterations;  // those are its own
    setting.run = [run, solver] { return run(solver); };
    plan.settings.push_back(std::move(setting));
  }
}

Plan clothPlan() {
  Plan plan;
  plan.knob = "1 / iterations of Bullet's links, 1 / small steps of ClothSolver, substep [s] of springs";
  plan.timed = "the whole step";
  return plan;
}

const char* const verlet = "mass-spring system in double by velocity Verlet, step 50 us";

std::vector<Study> studySag(const Effort& effort, const TellProgress& tell) {
  const SwingingCloth cloth;
  const double sag = sagOf(recordReference(cloth, referenceStep, sagDuration));
  const double coarse = sagOf(recordReference(cloth, 2 * referenceStep, sagDuration));
  Plan plan = clothPlan();
  plan.measures = {{"cloth_sag", "Sag of a hanging cloth of 1 m with springs of 1 kN/m",
                    "error of the lower edge's mean height, of the cloth's length", verlet,
                    richardsonError(coarse, sag, 2, 2) / SwingingCloth::length}};
  addSettings(plan, effort, sagDuration, [cloth, sag](const ClothSolver& solver) {
    const ClothRecord run = record(cloth, solver, sagDuration);
    return Outcome{{std::fabs(sagOf(run) - sag) / SwingingCloth::length}, run.seconds};
  });
  return carryOut(plan, effort, tell);
}

std::vector<Study> studySwing(const Effort& effort, const TellProgress& tell) {
  const SwingingCloth cloth{swingAngle};
  const ClothRecord fine = recordReference(cloth, referenceStep, swingDuration);
  const ClothRecord coarse = recordReference(cloth, 2 * referenceStep, swingDuration);
  const double period = periodOf(fine);
  const double drift = energyDriftOf(fine);
  Plan plan = clothPlan();
  plan.measures = {{"cloth_period", "Period of a swinging cloth of 1 m", "error of the period, of the period", verlet,
                    richardsonError(periodOf(coarse), period, 2, 2) / period},
                   {"cloth_energy", "Energy that a swinging cloth loses in two and a half periods",
                    "error of the energy's change, of the energy of the swing", verlet,
                    richardsonError(energyDriftOf(coarse), drift, 2, 2)}};
  addSettings(plan, effort, swingDuration, [cloth, period, drift](const ClothSolver& solver) {
    const ClothRecord run = record(cloth, solver, swingDuration);
    return Outcome{{std::fabs(periodOf(run) / period - 1), std::fabs(energyDriftOf(run) - drift)}, run.seconds};
  });
  return carryOut(plan, effort, tell);
}

}  // namespace

std::vector<Study> studyCloth(const Effort& effort, const TellProgress& tell) {
  std::vector<Study> studies = studySag(effort, [&](double fraction) { tell(0.3 * fraction); });
  for (Study& study : studySwing(effort, [&](double fraction) { tell(0.3 + 0.7 * fraction); })) {
    studies.push_back(std::move(study));
  }
  return studies;
}

}  // namespace accuracy
