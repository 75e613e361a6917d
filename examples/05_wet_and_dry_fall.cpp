// SPDX-License-Identifier: Zlib
// The same sheet falls 19.62 m: as plain Bullet has it (in a vacuum), dry, and wet, each beside its closed form.
// Only the air can tell wet from dry, and it takes much water to show: saturated cotton, 1.84 times as heavy, does
// not halve the time; the 84-fold mass of the paper's Table II does.

#include <bullet_wetcloth/bullet_wetcloth.h>

#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <cstdio>
#include <memory>

constexpr double kGravity = 9.81;           // [m/s^2]
constexpr double kHeight = 19.62;           // [m]
constexpr double kDryTimeConstant = 0.585;  // dry mass over drag, m/c [s]
constexpr double kSubstep = 1.0 / 240;      // [s]

struct Sheet {
  const char* name;
  double massRatio;  // wet over dry; 0: plain Bullet, no air
  std::unique_ptr<btSoftBody> body = nullptr;
  double time = 0;  // when it had fallen kHeight [s]
};

// In a vacuum sqrt(2 h / g); with drag linear in speed the root of y(t) = g tau (t - tau (1 - exp(-t / tau))).
double closedForm(double massRatio) {
  if (massRatio == 0) return std::sqrt(2 * kHeight / kGravity);
  const double tau = kDryTimeConstant * massRatio;
  double early = 0;
  double late = 100;
  while (late - early > 1e-9) {
    const double t = (early + late) / 2;
    const double y = kGravity * tau * (t - tau * (1 - std::exp(-t / tau)));
    (y < kHeight ? early : late) = t;
  }
  return late;
}

int main() {
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btSoftRigidDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity(btVector3(0, btScalar(-kGravity), 0));
  world.getWorldInfo().m_gravity = world.getGravity();
  world.getWorldInfo().m_sparsesdf.Initialize();
  wetcloth::WetClothWorld wet(world);

  Sheet sheets[] = {{"plain Bullet", 0}, {"dry", 1}, {"saturated cotton", 1.84}, {"saturated, Table II", 84}};
  wetcloth::ClothPatch patch;  // level, 1 m x 1 m
  patch.columns = patch.rows = 9;
  patch.edgeV = btVector3(0, 0, -1);
  for (Sheet& sheet : sheets) {
    sheet.body = patch.build(world.getWorldInfo());
    world.addSoftBody(sheet.body.get());
    patch.origin += btVector3(2, 0, 0);
    if (sheet.massRatio == 0) continue;
    wetcloth::Fabric fabric = wetcloth::Fabric::cotton();  // how heavy it is when dry does not matter, m / c does
    if (sheet.massRatio > 1) fabric.capacity = sheet.massRatio - 1;
    wetcloth::WetCloth& cloth = wet.add(*sheet.body, fabric);
    if (sheet.massRatio > 1) cloth.setSaturation(1);
    wetcloth::Wind::Parameters air;  // at rest
    air.law = wetcloth::Wind::Law::linear;
    air.linearDrag = fabric.arealDensity / kDryTimeConstant;
    cloth.add<wetcloth::Wind>(air);
  }

  for (int substep = 1; substep * kSubstep < 6; ++substep) {
    world.stepSimulation(btScalar(kSubstep), 0);
    for (Sheet& sheet : sheets) {
      // The sheets stay level: any node tells.
      const bool hasArrived = sheet.body->m_nodes[patch.node(4, 4)].m_x.y() <= -kHeight;
      if (sheet.time == 0 && hasArrived) sheet.time = substep * kSubstep;
    }
  }

  bool isRight = true;
  std::printf("A fall of %.2f m            time [s]  closed form [s]  difference [substeps]\n", kHeight);
  for (Sheet& sheet : sheets) {
    const double difference = (sheet.time - closedForm(sheet.massRatio)) / kSubstep;
    std::printf("%-24s  %10.3f  %15.3f  %21.2f\n", sheet.name, sheet.time, closedForm(sheet.massRatio), difference);
    isRight = isRight && std::fabs(difference) < 1.01;
    world.removeSoftBody(sheet.body.get());
  }
  return isRight ? 0 : 1;
}
