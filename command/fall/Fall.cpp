// SPDX-License-Identifier: Zlib
#include "command/fall/Fall.h"

#include "command/cli/Errors.h"
#include "command/fall/FallPhysics.h"
#include "command/fall/FallingCloth.h"
#include "command/scene/SoundState.h"
#include "command/timing/ProcessorTime.h"

#include <chrono>
#include <string>

namespace command {
namespace {

constexpr double paperTimeConstant = 0.585;  // m_dry / c [s]

/// Counts substeps until the cloth has fallen `height`; the last one counts as far as it was needed.
double timeToFall(FallingCloth& cloth, double height, double longest) {
  while (cloth.time() < longest) {
    const double before = cloth.fallen();
    const double start = cloth.time();
    cloth.substep();
    requireSound(cloth.blowUp(), cloth.time(), "; try another --world or --mode");
    if (cloth.fallen() >= height) return start + fallSubstep * (height - before) / (cloth.fallen() - before);
  }
  throw RunError("wetcloth: the cloth did not fall its " + std::to_string(height) + " m in " + std::to_string(longest) +
                 " s");
}

}  // namespace

FallMode FallMode::paper() {
  FallMode mode;
  mode.name = "paper";
  mode.defaultHeight = 19.62;
  mode.fabric = wetcloth::Fabric::tableII();
  mode.air.law = wetcloth::Wind::Law::linear;
  mode.air.linearDrag = mode.fabric.arealDensity / paperTimeConstant;
  const double saturated = 1 + mode.fabric.capacity;
  mode.cases = {{"bullet", 1, false}, {"dry", 1},     {"0.093 g", 9.3},        {"0.342 g", 34.2},
                {"0.591 g", 59.1},    {"0.84 g", 84}, {"saturated", saturated}};
  mode.remark =
      "The saturated cloth, 84 times as heavy, needs half the time of the dry one. Only air tells them apart: Bullet\n"
      "alone, in a vacuum, lets wet and dry fall alike.";
  return mode;
}

FallMode FallMode::physical() {
  FallMode mode;
  mode.name = "physical";
  mode.defaultHeight = 5.5;
  mode.fabric = wetcloth::Fabric::cotton();
  mode.fabric.arealDensity = 0.150;
  mode.air.law = wetcloth::Wind::Law::quadratic;
  mode.air.airDensity = 1.225;  // at sea level, 15 degrees Celsius
  mode.air.dragCoefficient = 1.2;
  const double capacity = mode.fabric.capacity;
  mode.cases = {{"bullet", 1, false},
                {"dry", 1},
                {"0.25 wet", 1 + 0.25 * capacity},
                {"0.50 wet", 1 + 0.50 * capacity},
                {"0.75 wet", 1 + 0.75 * capacity},
                {"saturated", 1 + capacity},
                {"4 x dry", 4}};
  mode.remark =
      "Saturated cotton is 1.84 times as heavy as dry and does not halve the time: that would take 4 times the mass.";
  return mode;
}

double FallMode::closedForm(const Case& fall, double height) const {
  if (!fall.inAir) return vacuumFallTime(height, fallGravity);
  const double arealDensity = fabric.arealDensity * fall.massRatio;
  if (air.law == wetcloth::Wind::Law::linear) {
    return linearDragFallTime(height, fallGravity, arealDensity / air.linearDrag);
  }
  return quadraticDragFallTime(height, fallGravity,
                               terminalSpeed(arealDensity, fallGravity, air.airDensity, air.dragCoefficient));
}

double FallMode::closedFormFallen(const Case& fall, double time) const {
  if (!fall.inAir) return vacuumFall(time, fallGravity);
  const double arealDensity = fabric.arealDensity * fall.massRatio;
  if (air.law == wetcloth::Wind::Law::linear) {
    return linearDragFall(time, fallGravity, arealDensity / air.linearDrag);
  }
  return quadraticDragFall(time, fallGravity,
                           terminalSpeed(arealDensity, fallGravity, air.airDensity, air.dragCoefficient));
}

FallResult fall(const FallMode& mode, const FallMode::Case& fallCase, double height, WorldKind kind,
                const std::optional<wetcloth::ClothSolver::Parameters>& clothSolver) {
  FallingCloth cloth(mode, fallCase, kind, clothSolver);
  FallResult result{fallCase.name, fallCase.massRatio, 0, mode.closedForm(fallCase, height), 0};
  const auto start = std::chrono::steady_clock::now();
  result.time = timeToFall(cloth, height, 2 * result.closedForm + 1);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  result.fps = result.time / (fallSubstep * fallSubstepsPerFrame) / atLeastATick(wall.count());
  return result;
}

}  // namespace command
