// SPDX-License-Identifier: Zlib
// Drops over a cloth of 64 x 64 nodes among ten bodies: our part of a step with them, less that without, over Bullet's
// own step of that cloth among those bodies. Medians of one run in which the two worlds take turns; `drops` is how many
// fly, in the mean.

#include "benchmarks/BenchCloth.h"
#include "tests/support/RigidBody.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <vector>

namespace {

using wetcloth_bench::median;
using wetcloth_bench::secondsOf;
using wetcloth_test::BodyScene;
using wetcloth_test::RigidBody;
using wetcloth_test::WorldKind;

constexpr int kBodies = 10;

class Scene {
 public:
  Scene() : m_scene(WorldKind::softRigid, patch(), btVector3(0, btScalar(-9.81), 0)) {
    m_scene.body().m_cfg.piterations = 10;
    for (int i = 0; i < kBodies; ++i) {
      const double angle = 2 * 3.14159265 * i / kBodies;
      const btVector3 place(btScalar(0.5 + 0.7 * std::cos(angle)), btScalar(-0.2),
                            btScalar(0.5 + 0.7 * std::sin(angle)));
      m_bodies.push_back(std::make_unique<RigidBody>(m_scene.bullet(), shape(i), btScalar(0), place));
    }
  }

  // Rain that keeps this many in the air: they fall some 0.8 s.
  void rain(int drops) {
    m_wet = std::make_unique<wetcloth::WetClothWorld>(m_scene.world(), wetcloth::Hook::manual);
    m_wet->add(m_scene.body());
    wetcloth::Drops::Parameters parameters;
    parameters.longestFlight = 0.8;
    parameters.mostDrops = 2 * drops;
    m_drops = std::make_unique<wetcloth::Drops>(*m_wet, parameters);
    wetcloth::Pour pour;
    pour.position = btVector3(btScalar(0.5), btScalar(2), btScalar(0.5));
    pour.velocity = btVector3(0, -1, 0);
    pour.mouthRadius = 0.8;
    pour.dropDiameter = 2e-3;
    pour.flow = drops / 0.68 * wetcloth::dropMass(pour.dropDiameter, parameters.air.waterDensity);
    m_drops->add(pour);
  }

  double step() {
    const double ours = m_wet ? secondsOf([&] { m_wet->preTick(btScalar(1) / 60); }) : 0;
    const double bullets = secondsOf([&] { m_scene.bullet().step(1, btScalar(1) / 60); });
    return m_wet ? ours : bullets;
  }
  std::size_t drops() const { return m_drops->size(); }

 private:
  static wetcloth::ClothPatch patch() {
    wetcloth::ClothPatch patch = wetcloth_test::squarePatch(64);
    patch.pinnedEdges = {wetcloth::ClothPatch::Edge::bottom, wetcloth::ClothPatch::Edge::top};
    return patch;
  }
  static std::unique_ptr<btCollisionShape> shape(int i) {
    if (i % 2 == 0) return wetcloth_test::box(0.1, 0.1, 0.1);
    return std::make_unique<btSphereShape>(btScalar(0.1));
  }

  BodyScene m_scene;
  std::vector<std::unique_ptr<RigidBody>> m_bodies;
  std::unique_ptr<wetcloth::WetClothWorld> m_wet;
  std::unique_ptr<wetcloth::Drops> m_drops;
};

void dropsOverACloth(benchmark::State& state) {
  Scene plain;
  Scene wet;
  wet.rain(static_cast<int>(state.range(0)));
  for (int step = 0; step < 60; ++step) {
    plain.step();
    wet.step();
  }
  std::vector<double> bullets;
  std::vector<double> ours;
  double drops = 0;
  for (auto _ : state) {
    static_cast<void>(_);
    bullets.push_back(plain.step());
    ours.push_back(wet.step());
    drops += static_cast<double>(wet.drops());
    state.SetIterationTime(ours.back());
  }
  state.counters["ratio"] = median(ours) / median(bullets);
  state.counters["bullet_ms"] = 1e3 * median(bullets);
  state.counters["drops_ms"] = 1e3 * median(ours);
  state.counters["drops"] = drops / static_cast<double>(ours.size());
}

}  // namespace

BENCHMARK(dropsOverACloth)
    ->Arg(100)
    ->Arg(1000)
    ->Arg(10000)
    ->UseManualTime()
    ->Iterations(200)
    ->Unit(benchmark::kMillisecond);
