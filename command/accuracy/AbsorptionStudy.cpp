// SPDX-License-Identifier: Zlib
#include "command/accuracy/Specimen.h"
#include "command/accuracy/Studies.h"

#include "command/timing/ProcessorTime.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

namespace accuracy {
namespace {

constexpr double cycleDuration = 8;
constexpr int specimenSide = 16;

// Exposure that changes in time, as of a cloth that is dipped and lifted: e(t) = (1 - cos(2 pi t / 8 s)) / 2.
double exposureAt(double time) { return 0.5 - 0.5 * std::cos(2 * pi * time / cycleDuration); }
/// Its integral from 0 [s].
double exposureUntil(double time) {
  return 0.5 * time - 0.5 * cycleDuration / (2 * pi) * std::sin(2 * pi * time / cycleDuration);
}

/// The classical fourth-order Runge-Kutta step of dw/dt = e(t) (C - w) / theta, which the library has no need of: to
/// show its order.
class RungeKuttaAbsorption : public wetcloth::Effect {
 public:
  struct Parameters {};
  explicit RungeKuttaAbsorption(Parameters) {}

  const char* name() const override { return "RungeKuttaAbsorption"; }
  wetcloth::Stage stage() const override { return wetcloth::Stage::sources; }
  void apply(wetcloth::WetCloth& cloth, const wetcloth::Step& step) override {
    const double theta = cloth.fabric().timeConstant;
    const auto rate = [&](double time) { return exposureAt(time) * step.dt / theta; };
    const double start = rate(step.time);
    const double middle = rate(step.time + step.dt / 2);
    const double end = rate(step.time + step.dt);
    const double k1 = start;
    const double k2 = middle * (1 - k1 / 2);
    const double k3 = middle * (1 - k2 / 2);
    const double k4 = end * (1 - k3);
    const double share = (k1 + 2 * k2 + 2 * k3 + k4) / 6;
    wetcloth::Water& water = cloth.water();
    for (std::size_t i = 0; i < water.size(); ++i) {
      water.absorb(i, share * (water.capacity(i) - water.held(i)), 0, 0, 0);
    }
  }
};

Specimen makeSpecimen() {
  Specimen::Settings settings;
  settings.patch = levelSquare(1, specimenSide);
  settings.fabric = wetcloth::Fabric::coarseWool();
  return Specimen(settings);
}

double closedForm(double time) {
  return 1 - std::exp(-exposureUntil(time) / wetcloth::Fabric::coarseWool().timeConstant);
}

/// What the world makes of a step of this length: float32 holds 1/60 s to 3e-8 only, which RK4 would show.
double asSeen(double dt) { return static_cast<double>(btScalar(dt)); }

/// Steps through the whole time. @param before  called before each step with its start [s]
template <class Before>
Outcome soak(Specimen& specimen, double dt, Before before) {
  const int steps = static_cast<int>(std::lround(cycleDuration / dt));
  Outcome outcome{{0}, 0};
  for (int i = 0; i < steps; ++i) {
    const double start = command::processorTime();
    before(i * asSeen(dt));
    specimen.substepOfOurs(dt);
    outcome.seconds += command::processorTime() - start;
    const double miss =
        std::fabs(specimen.cloth().saturation(0) - closedForm((i + 1) * asSeen(dt))) / closedForm(cycleDuration);
    outcome.errors[0] = std::max(outcome.errors[0], miss);
  }
  return outcome;
}

/// By an exposure that is set anew before each step.
Outcome soakStepByStep(double dt) {
  Specimen specimen = makeSpecimen();
  auto& absorption = specimen.cloth().add<wetcloth::Absorption>();
  return soak(specimen, dt, [&](double time) { adjust(absorption, [&](auto& p) { p.exposure = exposureAt(time); }); });
}

/// By an exposure that is a function of time, which the library takes in the middle of the step.
Outcome soakByLaw(wetcloth::Absorption::Law law, double dt) {
  Specimen specimen = makeSpecimen();
  wetcloth::Absorption::Parameters parameters;
  parameters.law = law;
  parameters.exposure = [](const btVector3&, const btVector3&, double time) { return exposureAt(time); };
  specimen.cloth().add<wetcloth::Absorption>(parameters);
  return soak(specimen, dt, [](double) {});
}

Outcome soakByRungeKutta(double dt) {
  Specimen specimen = makeSpecimen();
  specimen.cloth().add<RungeKuttaAbsorption>();
  return soak(specimen, dt, [](double) {});
}

void addCurve(Plan& plan, const std::string& method, const std::vector<double>& steps,
              const std::function<Outcome(double dt)>& run) {
  Setting curve;
  curve.method = method;
  curve.nodes = specimenSide * specimenSide;
  curve.simulatedSeconds = cycleDuration;
  addSteps(plan, curve, steps, run);
}

}  // namespace

std::vector<Study> studyAbsorption(const Effort& effort, const TellProgress& tell) {
  using Law = wetcloth::Absorption::Law;
  const std::vector<double> steps =
      effort.isQuick
          ? std::vector<double>{1. / 60, 0.1, 0.25, 1}
          : std::vector<double>{1e-3, 1. / 960, 1. / 480, 1. / 240, 1. / 120, 1. / 60, 1. / 30, 0.1, 0.25, 0.5, 1};
  Plan plan;
  plan.knob = "step [s]";
  plan.timed = "our part of the step: absorption and the commit of masses";
  plan.measures = {{"absorption", "Absorption under an exposure that changes in time",
                    "largest error of the saturation at any step, of the final saturation",
                    "closed form 1 - exp(-E(t) / theta), E the integral of the exposure"}};
  addCurve(plan, "forward Euler", steps, [](double dt) { return soakByLaw(Law::forwardEuler, dt); });
  addCurve(plan, "exact, exposure at the start", steps, soakStepByStep);
  addCurve(plan, "exact, exposure at the middle", steps, [](double dt) { return soakByLaw(Law::exponential, dt); });
  const std::size_t ours = plan.settings.size();
  addCurve(plan, "RK4 (not in the library)", steps, soakByRungeKutta);
  for (std::size_t i = ours; i < plan.settings.size(); ++i) plan.settings[i].isCompared = false;
  return carryOut(plan, effort, tell);
}

}  // namespace accuracy
