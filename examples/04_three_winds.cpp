// SPDX-License-Identifier: Zlib
// The paper's three winds, 0.5, 1.0 and 1.5, on its saturated flag; and a gust, which is a function of position and
// time, on a flag of real cotton, wet and dry. Five cloths in one world.

#include <bullet_wetcloth/bullet_wetcloth.h>

#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

struct Flag {
  const char* name;
  wetcloth::Fabric fabric;
  double saturation;
  wetcloth::Wind::Parameters wind;
  std::unique_ptr<btSoftBody> body = nullptr;
  double least = 1e9, mean = 0, most = -1e9;  // how far the free edge is downwind of the pole [m]
  double drop = 0;                            // mean of how far it hangs below its place in the flat flag [m]
};

// From the pole (x = y = 0) the flag's flat shape reaches along x; the wind blows along z.
wetcloth::Wind::Parameters paperWind(double value) {
  wetcloth::Wind::Parameters wind;
  wind.law = wetcloth::Wind::Law::paper;  // n (n . wind) on each triangle: no area, no speed of the cloth
  wind.velocity = btVector3(0, 0, btScalar(value));
  return wind;
}

wetcloth::Wind::Parameters gusts() {
  wetcloth::Wind::Parameters wind;
  wind.velocity = [](const btVector3& position, double time) {  // 2 to 6 m/s each 2 s, travelling downwind
    const double phase = time / 2 - static_cast<double>(position.z()) / 8;
    return btVector3(0, 0, btScalar(4 + 2 * std::sin(6.2832 * phase)));
  };
  return wind;
}

int main() {
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btSoftRigidDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity(btVector3(0, btScalar(-9.81), 0));
  world.getWorldInfo().m_gravity = world.getGravity();
  world.getWorldInfo().m_sparsesdf.Initialize();
  wetcloth::WetClothWorld wet(world);

  Flag flags[] = {{"paper 0.5, saturated", wetcloth::Fabric::tableII(), 1, paperWind(0.5)},
                  {"paper 1.0, saturated", wetcloth::Fabric::tableII(), 1, paperWind(1.0)},
                  {"paper 1.5, saturated", wetcloth::Fabric::tableII(), 1, paperWind(1.5)},
                  {"gusts, saturated cotton", wetcloth::Fabric::cotton(), 1, gusts()},
                  {"gusts, dry cotton", wetcloth::Fabric::cotton(), 0, gusts()}};
  wetcloth::ClothPatch patch;
  patch.columns = patch.rows = 16;
  patch.edgeU = btVector3(btScalar(0.5), 0, 0);
  patch.edgeV = btVector3(0, btScalar(0.5), 0);
  patch.pinnedEdges = {wetcloth::ClothPatch::Edge::left};
  for (Flag& flag : flags) {
    patch.arealDensity = flag.fabric.arealDensity;
    flag.body = patch.build(world.getWorldInfo());
    flag.body->m_cfg.piterations = 10;
    // The paper's wind has no drag in it: without any damping its flags never come to rest.
    if (flag.wind.law == wetcloth::Wind::Law::paper) flag.body->m_cfg.kDP = btScalar(0.01);
    world.addSoftBody(flag.body.get());
    wetcloth::WetCloth& cloth = wet.add(*flag.body, flag.fabric);
    cloth.setSaturation(flag.saturation);
    cloth.add<wetcloth::Wind>(flag.wind);
  }

  const int settling = 180;  // frames in which the flags find their place
  const double measured = 180;
  for (int frame = 0; frame < settling + measured; ++frame) {
    world.stepSimulation(btScalar(1) / 60, 4, btScalar(1) / 240);
    if (frame < settling) continue;
    for (Flag& flag : flags) {
      btVector3 edge(0, 0, 0);
      for (int j = 0; j < patch.rows; ++j) edge += flag.body->m_nodes[patch.node(patch.columns - 1, j)].m_x;
      edge /= btScalar(patch.rows);
      const double downwind = static_cast<double>(edge.z());
      flag.least = std::min(flag.least, downwind);
      flag.most = std::max(flag.most, downwind);
      flag.mean += downwind / measured;
      flag.drop += (0.25 - static_cast<double>(edge.y())) / measured;
    }
  }

  std::printf("Free edge of a flag of 0.5 m, during 3 s      downwind: least, mean, most [m]   drop [m]\n");
  for (const Flag& flag : flags) {
    std::printf("%-40s  %22.3f  %6.3f  %6.3f  %9.3f\n", flag.name, flag.least, flag.mean, flag.most, flag.drop);
  }
  for (Flag& flag : flags) world.removeSoftBody(flag.body.get());
  return flags[0].mean < flags[1].mean && flags[1].mean < flags[2].mean ? 0 : 1;
}
