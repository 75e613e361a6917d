// SPDX-License-Identifier: Zlib
#include "command/accuracy/ConvergenceOrder.h"
#include "command/accuracy/Specimen.h"
#include "command/accuracy/Studies.h"

#include "command/fall/FallPhysics.h"
#include "command/timing/ProcessorTime.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace accuracy {
namespace {

using Wind = wetcloth::Wind;

// --- a level sheet that falls -----------------------------------------------------------------------------------

constexpr double gravity = 9.81;
constexpr double sheetDuration = 1;
constexpr int fallSide = 12;
constexpr double voile = 0.030;  // a light cloth [kg/m^2]: the air stops it within a tenth of a second
constexpr double airDensity = 1.225;
constexpr double dragCoefficient = 1.2;
constexpr double linearTime = 0.1;  // m / c of the linear law [s]

Wind::Parameters stillAir(Wind::Law law, Wind::Integration integration) {
  Wind::Parameters air;
  air.law = law;
  air.integration = integration;
  air.airDensity = airDensity;
  air.dragCoefficient = dragCoefficient;
  air.linearDrag = voile / linearTime;
  return air;
}

double terminalSpeed(Wind::Law law) {
  return law == Wind::Law::linear ? gravity * linearTime
                                  : command::terminalSpeed(voile, gravity, airDensity, dragCoefficient);
}

double closedFormSpeed(Wind::Law law, double time) {
  const double terminal = terminalSpeed(law);
  return law == Wind::Law::linear ? terminal * (1 - std::exp(-time / linearTime))
                                  : terminal * std::tanh(gravity * time / terminal);
}

Outcome fallInAir(Wind::Law law, Wind::Integration integration, double dt) {
  Specimen::Settings settings;
  settings.patch = levelSquare(1, fallSide, voile);
  Specimen specimen(settings);
  specimen.cloth().add<Wind>(stillAir(law, integration));
  const btSoftBody::Node& middle = specimen.body().m_nodes[fallSide * fallSide / 2 + fallSide / 2];
  Outcome outcome{{0}, 0};
  for (int i = 1; i <= std::lround(sheetDuration / dt); ++i) {
    const double start = command::processorTime();
    specimen.substep(dt);
    outcome.seconds += command::processorTime() - start;
    const double miss = std::fabs(-static_cast<double>(middle.m_v.y()) - closedFormSpeed(law, i * dt));
    // Not std::max(), which would let NaN pass.
    if (!(miss / terminalSpeed(law) <= outcome.errors[0])) outcome.errors[0] = miss / terminalSpeed(law);
  }
  return outcome;
}

// --- a flag -----------------------------------------------------------------------------------------------------

constexpr int flagSide = 12;
constexpr double flagLength = 0.5;
constexpr double flagDuration = 0.2;

std::vector<btVector3> positionsOf(const btSoftBody& body) {
  std::vector<btVector3> positions;
  for (int i = 0; i < body.m_nodes.size(); ++i) positions.push_back(body.m_nodes[i].m_x);
  return positions;
}

/// Root mean square of the nodes' distances, of the flag's length.
double distance(const std::vector<btVector3>& a, const std::vector<btVector3>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += static_cast<double>((a[i] - b[i]).length2());
  return std::sqrt(sum / static_cast<double>(a.size())) / flagLength;
}

/// A flag with springs that converge with the step, as Bullet's links do not: level and edge-on at first. It swings
/// round and does not snap: a cloth that snaps amplifies every difference, so that no step would come near another.
std::vector<btVector3> fly(Wind::Integration integration, double dt, double* seconds = nullptr) {
  Specimen::Settings settings;
  settings.patch = levelSquare(flagLength, flagSide, voile);
  settings.patch.edgeV = btVector3(0, btScalar(-flagLength), 0);
  settings.patch.pinnedEdges = {wetcloth::ClothPatch::Edge::left};
  Specimen specimen(settings);
  Wind::Parameters wind;
  wind.velocity = btVector3(3, 0, btScalar(1.5));
  wind.integration = integration;
  specimen.cloth().add<Wind>(wind);
  wetcloth::HookeSprings::Parameters springs;
  springs.stiffness = 50;
  springs.bendingStiffness = 1;
  specimen.cloth().add<wetcloth::HookeSprings>(springs);
  const double start = command::processorTime();
  for (int i = 0; i < std::lround(flagDuration / dt); ++i) specimen.substep(dt);
  if (seconds != nullptr) *seconds = command::processorTime() - start;
  return positionsOf(specimen.body());
}

/// Four times finer than the finest that is studied: with a yet shorter step float32 is the greater error, since Bullet
/// makes velocities of differences of positions.
constexpr double flagReferenceStep = 1. / 15360;

/// With that step, and how wrong that is: the springs are of first order.
struct FlagReference {
  std::vector<btVector3> positions;
  double error;
};

FlagReference flagReference() {
  std::vector<btVector3> fine = fly(Wind::Integration::semiImplicit, flagReferenceStep);
  const double difference = distance(fly(Wind::Integration::semiImplicit, 2 * flagReferenceStep), fine);
  return {std::move(fine), richardsonError(0, difference, 2, 1)};
}

void addCurve(Plan& plan, const std::string& method, int side, double duration, const std::vector<double>& steps,
              const std::function<Outcome(double dt)>& run) {
  Setting curve;
  curve.method = method;
  curve.nodes = side * side;
  curve.simulatedSeconds = duration;
  addSteps(plan, curve, steps, run);
}

struct Integrator {
  const char* name;
  Wind::Integration integration;
};
constexpr Integrator integrators[] = {{"semi-implicit", Wind::Integration::semiImplicit},
                                      {"explicit", Wind::Integration::explicitEuler}};

std::vector<Study> studyFall(Wind::Law law, const char* name, const Effort& effort, const TellProgress& tell) {
  const std::vector<double> steps =
      effort.isQuick
          ? std::vector<double>{1. / 240, 1. / 60, 1. / 30, 0.1}
          : std::vector<double>{1e-3, 1. / 960, 1. / 480, 1. / 240, 1. / 120, 1. / 60, 1. / 30, 1. / 15, 0.1};
  Plan plan;
  plan.knob = "step [s]";
  plan.timed = "the whole step, Bullet's part included";
  plan.measures = {
      {std::string("wind_") + name, std::string("A level sheet of 30 g/m2 that falls, ") + name + " drag",
       "largest error of the speed at any step, of the terminal speed",
       law == Wind::Law::linear ? "closed form g tau (1 - exp(-t / tau))" : "closed form v tanh(g t / v)"}};
  for (const Integrator& integrator : integrators) {
    addCurve(plan, integrator.name, fallSide, sheetDuration, steps,
             [law, integrator](double dt) { return fallInAir(law, integrator.integration, dt); });
  }
  return carryOut(plan, effort, tell);
}

std::vector<Study> studyFlag(const Effort& effort, const TellProgress& tell) {
  const std::vector<double> steps = effort.isQuick ? std::vector<double>{1. / 240, 1. / 120, 1. / 60}
                                                   : std::vector<double>{1. / 3840, 1. / 1920, 1. / 960, 1. / 480,
                                                                         1. / 240,  1. / 120,  1. / 60,  1. / 30};
  const FlagReference reference = flagReference();
  Plan plan;
  plan.knob = "step [s]";
  plan.timed = "the whole step, Bullet's part included";
  plan.measures = {{"wind_flag", "A flag that the wind turns over, with true springs",
                    "root mean square of the nodes' distances after 0.2 s, of the flag's length",
                    "the same with a step of 1/15360 s", reference.error}};
  for (const Integrator& integrator : integrators) {
    addCurve(plan, integrator.name, flagSide, flagDuration, steps, [&reference, integrator](double dt) {
      Outcome outcome;
      outcome.errors = {distance(fly(integrator.integration, dt, &outcome.seconds), reference.positions)};
      return outcome;
    });
  }
  return carryOut(plan, effort, tell);
}

}  // namespace

std::vector<Study> studyWind(const Effort& effort, const TellProgress& tell) {
  std::vector<Study> studies;
  const auto add = [&](std::vector<Study> more) {
    for (Study& study : more) studies.push_back(std::move(study));
  };
  const auto third = [&](int part) { return [&tell, part](double fraction) { tell((part + fraction) / 3); }; };
  add(studyFall(Wind::Law::linear, "linear", effort, third(0)));
  add(studyFall(Wind::Law::quadratic, "quadratic", effort, third(1)));
  add(studyFlag(effort, third(2)));
  return studies;
}

}  // namespace accuracy
