#include "Fall.h"

#include "BulletWorld.h"
#include "Errors.h"
#include "FallPhysics.h"

#include <chrono>
#include <memory>

namespace runner {
namespace {

constexpr double paperTimeConstant = 0.585;  // m_dry / c [s]

/// Height of the centre of mass. All nodes of one fabric are equally wet, so their masses weigh as their areas do.
double centreHeight(const btSoftBody& body) {
  double moment = 0;
  double mass = 0;
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    const double nodeMass = 1 / static_cast<double>(body.m_nodes[i].m_im);
    moment += nodeMass * static_cast<double>(body.m_nodes[i].m_x.y());
    mass += nodeMass;
  }
  return moment / mass;
}

void wet(wetcloth::WetCloth& cloth, double massRatio) {
  std::vector<double> water;
  for (int i = 0; i < cloth.nodeCount(); ++i) water.push_back((massRatio - 1) * cloth.dryMass(i));
  cloth.setHeld(water);
}

/// Without springs a sheet in the deformable world is a cloud of triangles, which the air crumples. These are half as
/// stiff as would make the explicit world unstable.
DeformableSprings springsFor(const wetcloth::ClothPatch& patch, double massRatio) {
  const double area = static_cast<double>(patch.edgeU.cross(patch.edgeV).length());
  const double nodeMass = massRatio * patch.arealDensity * area / patch.nodeCount();
  DeformableSprings springs;
  springs.stiffness = springs.bendingStiffness = 0.15 * nodeMass / (fallSubstep * fallSubstep);
  springs.damping = 0;
  return springs;
}

/// Air is everywhere alike, so the fall may be watched from a lift that stops at every metre: near the origin, float32
/// still resolves the small steps of a long fall. The shift is exact. Not through btSoftBody::translate(), which makes
/// the present lengths of the links their rest lengths.
void liftByOneMetre(btSoftBody& body) {
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    body.m_nodes[i].m_x += btVector3(0, 1, 0);
    body.m_nodes[i].m_q += btVector3(0, 1, 0);
  }
  body.updateBounds();
}

/// Counts substeps until the cloth has fallen `height`; the last one counts as far as it was needed.
double timeToFall(BulletWorld& world, btSoftBody& body, double height, double longest) {
  double lifted = 0;
  double before = 0;
  for (long long substeps = 0; static_cast<double>(substeps) * fallSubstep < longest; ++substeps) {
    world.substep(btScalar(fallSubstep));
    const double fallen = lifted - centreHeight(body);
    if (fallen >= height) {
      return fallSubstep * (static_cast<double>(substeps) + (height - before) / (fallen - before));
    }
    before = fallen;
    for (; fallen - lifted > 1; ++lifted) liftByOneMetre(body);
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

FallResult fall(const FallMode& mode, const FallMode::Case& fallCase, double height, WorldKind kind) {
  BulletWorld::Settings settings;
  settings.kind = kind;
  settings.gravity = btVector3(0, btScalar(-fallGravity), 0);
  BulletWorld world(settings);
  wetcloth::ClothPatch patch;  // its nodes are 1/32 m apart, which is exact: rounding would seed crumples
  patch.edgeU = btVector3(btScalar(31.0 / 32), 0, 0);
  patch.edgeV = btVector3(0, 0, btScalar(-31.0 / 32));
  patch.arealDensity = mode.fabric.arealDensity;
  const DeformableSprings springs = springsFor(patch, fallCase.massRatio);
  btSoftBody& body = world.add(patch.build(world.worldInfo()), &springs);
  std::unique_ptr<wetcloth::WetClothWorld> wetWorld;
  if (fallCase.inAir) {
    wetWorld = std::make_unique<wetcloth::WetClothWorld>(world.world());
    wetcloth::WetCloth& cloth = wetWorld->add(body, mode.fabric);
    cloth.add<wetcloth::Wind>(mode.air);
    wet(cloth, fallCase.massRatio);
  }
  FallResult result{fallCase.name, fallCase.massRatio, 0, mode.closedForm(fallCase, height), 0};
  const auto start = std::chrono::steady_clock::now();
  result.time = timeToFall(world, body, height, 2 * result.closedForm + 1);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  result.fps = result.time / (fallSubstep * fallSubstepsPerFrame) / wall.count();
  return result;
}

}  // namespace runner
