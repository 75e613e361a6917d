// SPDX-License-Identifier: Zlib
#include "command/accuracy/Specimen.h"
#include "command/accuracy/Studies.h"

#include "command/timing/ProcessorTime.h"

#include <cmath>
#include <string>
#include <utility>

namespace accuracy {
namespace {

using Method = wetcloth::Diffusion::Method;

constexpr double waveDuration = 5;
constexpr double waveDiffusivity = 0.01;  // [m^2/s]: the longest wave of a cloth of 1 m falls to 0.61 in that time

/// The longest wave between two edges that nothing crosses: s = 1/2 + 0.4 cos(pi x) exp(-D pi^2 t), x in [0, 1] m.
double waveAt(double x, double time) { return 0.4 * std::cos(pi * x) * std::exp(-waveDiffusivity * pi * pi * time); }

void setWave(Specimen& specimen) {
  wetcloth::WetCloth& cloth = specimen.cloth();
  std::vector<double> held(static_cast<std::size_t>(cloth.nodeCount()));
  for (int i = 0; i < cloth.nodeCount(); ++i) {
    const double x = static_cast<double>(specimen.body().m_nodes[i].m_x.x());
    held[static_cast<std::size_t>(i)] = (0.5 + waveAt(x, 0)) * cloth.capacity(i);
  }
  cloth.setHeld(held);
}

/// Root of the mean square over the nodes, of the wave's height then.
double waveError(Specimen& specimen) {
  double sum = 0;
  for (int i = 0; i < specimen.cloth().nodeCount(); ++i) {
    const double x = static_cast<double>(specimen.body().m_nodes[i].m_x.x());
    const double miss = specimen.cloth().saturation(i) - 0.5 - waveAt(x, waveDuration);
    sum += miss * miss;
  }
  return std::sqrt(sum / specimen.nodes()) / waveAt(0, waveDuration);
}

Outcome flatten(Method method, int side, double dt) {
  Specimen::Settings settings;
  settings.patch = levelSquare(1, side);
  Specimen specimen(settings);
  wetcloth::Diffusion::Parameters parameters;
  parameters.warpDiffusivity = parameters.weftDiffusivity = waveDiffusivity;
  parameters.exponent = 0;
  parameters.method = method;
  specimen.cloth().add<wetcloth::Diffusion>(parameters);
  setWave(specimen);
  const int steps = static_cast<int>(std::lround(waveDuration / dt));
  const double start = command::processorTime();
  for (int i = 0; i < steps; ++i) specimen.substepOfOurs(dt);
  const double seconds = command::processorTime() - start;
  return {{waveError(specimen)}, seconds};
}

Setting settingOf(const std::string& curve, const std::string& label, Method method, int side, double dt) {
  Setting setting;
  setting.method = curve;
  setting.label = label;
  setting.knob = dt;
  setting.nodes = side * side;
  setting.steps = waveDuration / dt;
  setting.simulatedSeconds = waveDuration;
  setting.run = [=] { return flatten(method, side, dt); };
  return setting;
}

void addSteps(Plan& plan, const std::string& name, Method method, int side, const std::vector<double>& steps) {
  for (const double dt : steps) {
    plan.settings.push_back(settingOf(name, stepLabel(dt), method, side, dt));
    plan.settings.back().substep = dt;
  }
}

void addMeshes(Plan& plan, const std::vector<int>& sides) {
  for (const int side : sides) {
    const std::string label = std::to_string(side) + " x " + std::to_string(side);
    plan.settings.push_back(settingOf("mesh, factored at 1/960 s", label, Method::factored, side, 1. / 960));
    plan.settings.back().knob = 1. / (side - 1);
    plan.settings.back().isCompared = false;  // its time is that of another mesh
  }
}

}  // namespace

std::vector<Study> studyDiffusion(const Effort& effort, const TellProgress& tell) {
  const int side = effort.isQuick ? 24 : 64;
  const std::vector<double> steps =
      effort.isQuick ? std::vector<double>{1. / 60, 0.1, 0.5}
                     : std::vector<double>{1. / 960, 1. / 480, 1. / 240, 1. / 120, 1. / 60, 1. / 30, 0.1, 0.25, 0.5, 1};
  Plan plan;
  plan.knob = "step [s], mesh width [m]";
  plan.timed = "our part of the step: diffusion and the commit of masses";
  plan.measures = {{"diffusion",
                    "A wave of water that flattens, " + std::to_string(side) + " x " + std::to_string(side),
                    "root mean square error of the saturation after 5 s, of the wave's height",
                    "closed form cos(pi x) exp(-D pi^2 t)"}};
  addSteps(plan, "factored", Method::factored, side, steps);
  addSteps(plan, "conjugate gradients", Method::conjugateGradients, side, steps);
  addSteps(plan, "explicit substeps", Method::explicitSubsteps, side, steps);
  addMeshes(plan, effort.isQuick ? std::vector<int>{6, 12, 24} : std::vector<int>{8, 16, 32, 64});
  return carryOut(plan, effort, tell);
}

}  // namespace accuracy
