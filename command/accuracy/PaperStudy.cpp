// SPDX-License-Identifier: Zlib
#include "command/accuracy/Specimen.h"
#include "command/accuracy/Studies.h"

#include "command/timing/ProcessorTime.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

namespace accuracy {
namespace {

constexpr double paperStep = 1. / 60;

// --- absorption: dry to 10 s in water ----------------------------------------------------------------------------

constexpr double soakDuration = 10;

Outcome soak(wetcloth::Absorption::Law law) {
  Specimen::Settings settings;
  settings.patch = levelSquare(1, 16);
  Specimen specimen(settings);
  wetcloth::Absorption::Parameters parameters;
  parameters.law = law;
  specimen.cloth().add<wetcloth::Absorption>(parameters);
  const double start = command::processorTime();
  for (int i = 0; i < std::lround(soakDuration / paperStep); ++i) specimen.substepOfOurs(paperStep);
  const double seconds = command::processorTime() - start;
  const double exact = 1 - std::exp(-soakDuration / settings.fabric.timeConstant);
  return {{std::fabs(specimen.cloth().saturation(0) / exact - 1)}, seconds};
}

/// Eq. 1 as it is printed, m += t dm/paperStep with the time since the start instead of the step: on one number, in no
/// effect, since nobody should have it.
Outcome soakAsPrinted() {
  const wetcloth::Fabric cotton = wetcloth::Fabric::cotton();
  double saturation = 0;
  const double start = command::processorTime();
  for (int i = 0; i < std::lround(soakDuration / paperStep); ++i) {
    const double rate = std::exp(-i * paperStep / cotton.timeConstant) / cotton.timeConstant;
    saturation = std::min(1.0, saturation + i * paperStep * rate);
  }
  const double seconds = command::processorTime() - start;
  const double exact = 1 - std::exp(-soakDuration / cotton.timeConstant);
  return {{std::fabs(saturation / exact - 1)}, seconds};
}

// --- wind on a level square metre --------------------------------------------------------------------------------

Outcome blow(const wetcloth::Wind::Parameters& wind, int side) {
  Specimen::Settings settings;
  settings.patch = levelSquare(1, side);
  Specimen specimen(settings);
  const auto& effect = specimen.cloth().add<wetcloth::Wind>(wind);
  constexpr int steps = 60;
  const double start = command::processorTime();
  for (int i = 0; i < steps; ++i) specimen.substepOfOurs(1e-9);
  const double seconds = command::processorTime() - start;
  const double speed = static_cast<double>(wind.velocity.at(btVector3(0, 0, 0), 0).y());
  const double pressure = wind.airDensity * wind.dragCoefficient * speed * speed / 2;
  return {{std::fabs(static_cast<double>(effect.totalForce().y()) / pressure - 1)}, seconds};
}

wetcloth::Wind::Parameters breeze(wetcloth::Wind::Law law) {
  wetcloth::Wind::Parameters wind;
  wind.velocity = btVector3(0, 1, 0);
  wind.law = law;
  wind.integration = wetcloth::Wind::Integration::explicitEuler;
  return wind;
}

// --- water at rest that joins a falling cloth --------------------------------------------------------------------

/// Momentum after a fall in a vacuum during which the cloth soaks, against the impulse of gravity, the integral of
/// m(t) g.
Outcome soakInFall(bool conservesMomentum) {
  constexpr double duration = 2;
  Specimen::Settings settings;
  settings.patch = levelSquare(1, 16);
  Specimen specimen(settings);
  wetcloth::Absorption::Parameters parameters;
  parameters.conservesMomentum = conservesMomentum;
  specimen.cloth().add<wetcloth::Absorption>(parameters);
  const double dry = specimen.cloth().totalMass();
  const double start = command::processorTime();
  for (int i = 0; i < std::lround(duration / paperStep); ++i) specimen.substep(paperStep);
  const double seconds = command::processorTime() - start;
  double momentum = 0;
  for (int i = 0; i < specimen.cloth().nodeCount(); ++i) {
    const double mass = specimen.cloth().dryMass(i) + specimen.cloth().held(i);
    momentum -= mass * static_cast<double>(specimen.body().m_nodes[i].m_v.y());
  }
  const double theta = settings.fabric.timeConstant;
  const double water = settings.fabric.capacity * (duration - theta * (1 - std::exp(-duration / theta)));
  return {{std::fabs(momentum / (dry * 9.81 * (duration + water)) - 1)}, seconds};
}

void add(Plan& plan, const std::string& method, const std::string& label, double nodes, double steps, double seconds,
         std::function<Outcome()> run) {
  Setting setting;
  setting.method = method;
  setting.label = label;
  setting.nodes = nodes;
  setting.steps = steps;
  setting.simulatedSeconds = seconds;
  setting.run = std::move(run);
  plan.settings.push_back(std::move(setting));
}

std::vector<Study> studySoaking(const Effort& effort, const TellProgress& tell) {
  using Law = wetcloth::Absorption::Law;
  Plan plan;
  plan.knob = "none";
  plan.timed = "our part of the step at 1/60 s; of Eq. 1 as printed one number";
  plan.measures = {{"paper_absorption", "The paper's absorption, 10 s in water", "error of the water taken up",
                    "closed form, Eq. 2"}};
  const double steps = soakDuration / paperStep;
  add(plan, "paper", "Eq. 1 by forward Euler", 256, steps, soakDuration, [] { return soak(Law::forwardEuler); });
  add(plan, "paper", "Eq. 1 as printed", 1, steps, soakDuration, soakAsPrinted);
  plan.settings.back().isCompared = false;
  add(plan, "physics", "exact law", 256, steps, soakDuration, [] { return soak(Law::exponential); });
  return carryOut(plan, effort, tell);
}

std::vector<Study> studyBreeze(const Effort& effort, const TellProgress& tell) {
  using Law = wetcloth::Wind::Law;
  Plan plan;
  plan.knob = "none";
  plan.timed = "our part of the step";
  plan.measures = {{"paper_wind", "The paper's wind of 1 m/s across a level square metre",
                    "error of the force on the whole cloth", "closed form 1/2 rho C_d A u^2"}};
  for (const int side : {16, 32, 64}) {
    const std::string mesh = std::to_string(side) + " x " + std::to_string(side);
    add(plan, "paper, no area", mesh, side * side, 60, 1, [side] { return blow(breeze(Law::paper), side); });
    add(plan, "physics, pressure x area", mesh, side * side, 60, 1,
        [side] { return blow(breeze(Law::quadratic), side); });
  }
  return carryOut(plan, effort, tell);
}

std::vector<Study> studyMomentum(const Effort& effort, const TellProgress& tell) {
  Plan plan;
  plan.knob = "none";
  plan.timed = "the whole step at 1/60 s, Bullet's part included";
  plan.measures = {{"paper_momentum", "A cloth that soaks while it falls for 2 s", "error of the momentum",
                    "closed form: the impulse of gravity on the growing mass"}};
  add(plan, "paper", "mass without momentum", 256, 120, 2, [] { return soakInFall(false); });
  add(plan, "physics", "mass with momentum", 256, 120, 2, [] { return soakInFall(true); });
  return carryOut(plan, effort, tell);
}

}  // namespace

std::vector<Study> studyPaper(const Effort& effort, const TellProgress& tell) {
  std::vector<Study> studies;
  const auto append = [&](std::vector<Study> more) {
    for (Study& study : more) studies.push_back(std::move(study));
  };
  append(studySoaking(effort, [&](double fraction) { tell(fraction / 3); }));
  append(studyBreeze(effort, [&](double fraction) { tell((1 + fraction) / 3); }));
  append(studyMomentum(effort, [&](double fraction) { tell((2 + fraction) / 3); }));
  return studies;
}

}  // namespace accuracy
