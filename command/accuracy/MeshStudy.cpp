// SPDX-License-Identifier: Zlib
#include "command/accuracy/BarenblattSpread.h"
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

std::string meshLabel(int side) { return std::to_string(side) + " x " + std::to_string(side); }

void addSides(Plan& plan, const std::string& method, const std::vector<int>& sides, int rows, double steps,
              double duration, const std::function<Outcome(int side)>& run) {
  for (const int side : sides) {
    Setting setting;
    setting.method = method;
    setting.label = rows == 0 ? meshLabel(side) : std::to_string(side) + " nodes along";
    setting.knob = 1. / (side - 1);
    setting.nodes = side * (rows == 0 ? side : rows);
    setting.steps = steps;
    setting.simulatedSeconds = duration;
    setting.run = [run, side] { return run(side); };
    plan.settings.push_back(std::move(setting));
  }
}

// --- the wind's force on a quarter of a cylinder -------------------------------------------------------------------

constexpr double windSpeed = 5;
constexpr double radius = 1;
// 45 degrees [rad]. Not 60: there the error of flat triangles and that of their sum cancel each other.
constexpr double halfAngle = 0.7853981633974483;

/// Integral of 1/2 rho C_d U^2 cos(phi)^3 over the cylinder's surface, of height 1 m, along the wind [N].
double closedFormForce(const Wind::Parameters& wind) {
  const double integral = 2 * (std::sin(halfAngle) - std::pow(std::sin(halfAngle), 3) / 3);
  return wind.airDensity * wind.dragCoefficient * windSpeed * windSpeed / 2 * radius * integral;
}

void bend(btSoftBody& body) {
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    btSoftBody::Node& node = body.m_nodes[i];
    const double phi = halfAngle * (2 * static_cast<double>(node.m_x.x()) - 1);
    node.m_x.setValue(btScalar(radius * std::sin(phi)), btScalar(radius * std::cos(phi)), node.m_x.z());
  }
}

Outcome blowOnCylinder(int side) {
  Specimen::Settings settings;
  settings.patch = levelSquare(1, side);
  Specimen specimen(settings);
  bend(specimen.body());
  Wind::Parameters parameters;
  parameters.velocity = btVector3(0, btScalar(-windSpeed), 0);
  parameters.integration = Wind::Integration::explicitEuler;
  const Wind& wind = specimen.cloth().add<Wind>(parameters);
  constexpr int steps = 10;
  const double start = command::processorTime();
  // So short that the cloth is still at rest when it is over.
  for (int i = 0; i < steps; ++i) specimen.substepOfOurs(1e-9);
  const double seconds = command::processorTime() - start;
  const double force = -static_cast<double>(wind.totalForce().y());
  return {{std::fabs(force / closedFormForce(parameters) - 1)}, seconds};
}

std::vector<Study> studyWindMesh(const std::vector<int>& sides, const Effort& effort, const TellProgress& tell) {
  Plan plan;
  plan.knob = "mesh width, of the cloth's side";
  plan.timed = "our part of the step, ten steps";
  plan.measures = {{"mesh_wind", "Force of the wind on a quarter of a cylinder", "error of the force, of the force",
                    "closed form: integral of the pressure over the surface"}};
  addSides(plan, "quadratic drag", sides, 0, 10, 1, blowOnCylinder);
  return carryOut(plan, effort, tell);
}

// --- water that spreads behind a front ---------------------------------------------------------------------------

Outcome spread(int columns) {
  const BarenblattSpread form;
  Specimen::Settings settings;
  settings.patch = levelSquare(1, columns);
  settings.patch.rows = 3;
  settings.patch.edgeV = btVector3(0, 0, btScalar(2. / (columns - 1)));
  Specimen specimen(settings);
  wetcloth::Diffusion::Parameters parameters;
  parameters.warpDiffusivity = parameters.weftDiffusivity = BarenblattSpread::diffusivity;
  parameters.exponent = 2;
  wetcloth::WetCloth& cloth = specimen.cloth();
  cloth.add<wetcloth::Diffusion>(parameters);
  const auto place = [&](int i) { return static_cast<double>(specimen.body().m_nodes[i].m_x.x()) - 0.5; };
  std::vector<double> held;
  for (int i = 0; i < cloth.nodeCount(); ++i) held.push_back(form.saturation(place(i), 0) * cloth.capacity(i));
  cloth.setHeld(held);
  const double start = command::processorTime();
  for (int i = 0; i < std::lround(BarenblattSpread::duration * 960); ++i) specimen.substepOfOurs(1. / 960);
  const double seconds = command::processorTime() - start;
  double miss = 0;
  double all = 0;
  for (int i = 0; i < cloth.nodeCount(); ++i) {
    const double expected = form.saturation(place(i), BarenblattSpread::duration);
    miss += std::fabs(cloth.saturation(i) - expected) * cloth.capacity(i);
    all += expected * cloth.capacity(i);
  }
  return {{miss / all}, seconds};
}

std::vector<Study> studyWickingMesh(const std::vector<int>& sides, const Effort& effort, const TellProgress& tell) {
  Plan plan;
  plan.knob = "mesh width, of the strip's length";
  plan.timed = "our part of the step: diffusion and the commit of masses";
  plan.measures = {{"mesh_wicking", "Water that spreads over a strip behind a front, D s^2",
                    "water at the wrong place after 5 s, of all water", "closed form of Barenblatt (1952)"}};
  addSides(plan, "factored at 1/960 s", sides, 3, 960 * BarenblattSpread::duration, BarenblattSpread::duration, spread);
  return carryOut(plan, effort, tell);
}

// --- a fall ------------------------------------------------------------------------------------------------------

constexpr double fallDuration = 0.5;
constexpr double fallStep = 1. / 240;

Outcome fallInAir(int side) {
  Specimen::Settings settings;
  settings.patch = levelSquare(1, side);
  Specimen specimen(settings);
  const Wind::Parameters air;
  specimen.cloth().add<Wind>(air);
  const double start = command::processorTime();
  for (int i = 0; i < std::lround(fallDuration / fallStep); ++i) specimen.substep(fallStep);
  const double seconds = command::processorTime() - start;
  double height = 0;
  for (int i = 0; i < specimen.body().m_nodes.size(); ++i) {
    height += static_cast<double>(specimen.body().m_nodes[i].m_x.y()) / specimen.nodes();
  }
  const double terminal =
      command::terminalSpeed(settings.patch.arealDensity, 9.81, air.airDensity, air.dragCoefficient);
  return {{std::fabs(-height / command::quadraticDragFall(fallDuration, 9.81, terminal) - 1)}, seconds};
}

std::vector<Study> studyFallMesh(const std::vector<int>& sides, const Effort& effort, const TellProgress& tell) {
  Plan plan;
  plan.knob = "mesh width, of the cloth's side";
  plan.timed = "the whole step, Bullet's part included";
  plan.measures = {{"mesh_fall", "A level sheet that falls through air", "error of the distance fallen in 0.5 s",
                    "closed form (v^2 / g) ln cosh(g t / v)"}};
  addSides(plan, "fall at 1/240 s", sides, 0, fallDuration / fallStep, fallDuration, fallInAir);
  return carryOut(plan, effort, tell);
}

}  // namespace

std::vector<Study> studyMesh(const Effort& effort, const TellProgress& tell) {
  const std::vector<int> sides = effort.isQuick ? std::vector<int>{8, 16, 32} : std::vector<int>{16, 32, 64, 128, 256};
  std::vector<Study> studies;
  const auto add = [&](std::vector<Study> more) {
    for (Study& study : more) studies.push_back(std::move(study));
  };
  const auto third = [&](int part) { return [&tell, part](double fraction) { tell((part + fraction) / 3); }; };
  add(studyWindMesh(sides, effort, third(0)));
  add(studyWickingMesh(sides, effort, third(1)));
  add(studyFallMesh(sides, effort, third(2)));
  return studies;
}

}  // namespace accuracy
