// SPDX-License-Identifier: Zlib
// How far a hanging strip stretches: Bullet's links by how far its solver has converged, HookeSprings by the load.
// Arguments: position iterations, substeps of 1/60 s, percent of saturation. Counter: the tip's extension in mm.

#include <bullet_wetcloth/bullet_wetcloth.h>

#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <benchmark/benchmark.h>
#include <btBulletDynamicsCommon.h>

namespace {

enum class Stretch { bulletsLinks, hookeSprings };

constexpr int kRows = 21;

// 10 g, 1 m long, 5 cm wide; flexion springs without force, so that the closed form is a chain's.
wetcloth::ClothPatch strip() {
  wetcloth::ClothPatch patch;
  patch.columns = 2;
  patch.rows = kRows;
  patch.edgeU = btVector3(btScalar(0.05), 0, 0);
  patch.edgeV = btVector3(0, -1, 0);
  patch.arealDensity = 0.2;
  patch.flexionStiffness = 1e-9;
  patch.pinnedEdges = {wetcloth::ClothPatch::Edge::bottom};
  return patch;
}

// Mean over the last ten of twenty seconds [m].
double extension(Stretch stretch, int iterations, int substeps, double saturation) {
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btSoftRigidDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.getWorldInfo().m_gravity.setValue(0, btScalar(-9.81), 0);
  const auto body = strip().build(world.getWorldInfo());
  body->m_cfg.piterations = iterations;
  world.addSoftBody(body.get());
  double sum = 0;
  const int steps = 1200 * substeps;
  {
    wetcloth::WetClothWorld wet(world);
    wetcloth::WetCloth& cloth = wet.add(*body);
    if (stretch == Stretch::hookeSprings) {
      wetcloth::HookeSprings::Parameters springs;
      springs.stiffness = 50;
      springs.bendingStiffness = 0;
      cloth.add<wetcloth::HookeSprings>(springs);
    }
    cloth.setSaturation(saturation);
    for (int i = 0; i < steps; ++i) {
      world.stepSimulation(btScalar(1) / static_cast<btScalar>(60 * substeps), 0);
      if (i >= steps / 2) sum += -1 - static_cast<double>(body->m_nodes[2 * kRows - 2].m_x.y());
    }
  }
  world.removeSoftBody(body.get());
  return sum / (steps - steps / 2);
}

void hangingStrip(benchmark::State& state, Stretch stretch) {
  double metres = 0;
  for (auto _ : state) {
    static_cast<void>(_);
    metres = extension(stretch, static_cast<int>(state.range(0)), static_cast<int>(state.range(1)),
                       static_cast<double>(state.range(2)) / 100);
  }
  state.counters["extension_mm"] = metres * 1000;
}

void settings(benchmark::internal::Benchmark* each) {
  each->Unit(benchmark::kMillisecond)->Iterations(1)->ArgsProduct({{10, 100}, {1, 4}, {0, 100}});
}

BENCHMARK_CAPTURE(hangingStrip, bulletsLinks, Stretch::bulletsLinks)->Apply(settings);
BENCHMARK_CAPTURE(hangingStrip, hookeSprings, Stretch::hookeSprings)->Apply(settings);

}  // namespace
