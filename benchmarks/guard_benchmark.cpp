// SPDX-License-Identifier: Zlib
// ClothSolver with its guard against the same without. `ratio` is a step with it over a step without, medians of one
// run in which both take turns; `looks` and `pairs` are the guard's in a step and at a look.

#include "benchmarks/BenchCloth.h"
#include "tests/support/RigidBody.h"

#include <benchmark/benchmark.h>

#include <memory>
#include <optional>
#include <vector>

namespace {

using wetcloth_bench::median;
using wetcloth_bench::secondsOf;
using wetcloth_test::BulletWorld;
using wetcloth_test::RigidBody;
using wetcloth_test::WorldKind;

using Guard = std::optional<wetcloth::ClothSolver::Guard>;

// A world with cloths, guarded or not, and perhaps a floor at y = 0.
class Scene {
 public:
  Scene(const std::vector<wetcloth::ClothPatch>& patches, const Guard& guard, bool hasFloor, int smallSteps)
      : m_solver(parametersOf(guard, smallSteps)),
        m_bullet(WorldKind::softRigid, btVector3(0, btScalar(-9.81), 0), &m_solver) {
    if (hasFloor) {
      m_floor = std::make_unique<RigidBody>(m_bullet, std::make_unique<btBoxShape>(btVector3(3, 1, 3)), btScalar(0),
                                            btVector3(0, -1, 0));
    }
    for (const wetcloth::ClothPatch& patch : patches) {
      m_bodies.push_back(patch.build(m_bullet.info()));
      m_bodies.back()->getCollisionShape()->setMargin(btScalar(0.01));
      m_bodies.back()->m_cfg.kDF = btScalar(0.5);
      m_bullet.add(*m_bodies.back());
    }
  }
  ~Scene() {
    for (const auto& body : m_bodies) m_bullet.remove(*body);
  }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  void step() { m_bullet.step(1, btScalar(1) / 60); }
  wetcloth::ClothSolver& solver() { return m_solver; }

 private:
  static wetcloth::ClothSolver::Parameters parametersOf(const Guard& guard, int smallSteps) {
    wetcloth::ClothSolver::Parameters parameters;
    parameters.guard = guard;
    parameters.smallSteps = smallSteps;
    return parameters;
  }
  wetcloth::ClothSolver m_solver;
  BulletWorld m_bullet;
  std::unique_ptr<RigidBody> m_floor;
  std::vector<std::unique_ptr<btSoftBody>> m_bodies;
};

void compare(benchmark::State& state, const std::vector<wetcloth::ClothPatch>& patches, bool hasFloor, int warmUp,
             const Guard& without = std::nullopt, const Guard& with = wetcloth::ClothSolver::Guard(),
             int smallSteps = wetcloth::ClothSolver::Parameters().smallSteps) {
  Scene plain(patches, without, hasFloor, smallSteps);
  Scene guarded(patches, with, hasFloor, smallSteps);
  for (int step = 0; step < warmUp; ++step) {
    plain.step();
    guarded.step();
  }
  guarded.solver().resetGuardTotals();
  std::vector<double> times[2];
  for (auto _ : state) {
    static_cast<void>(_);
    times[0].push_back(secondsOf([&] { plain.step(); }));
    times[1].push_back(secondsOf([&] { guarded.step(); }));
    state.SetIterationTime(times[1].back());
  }
  const wetcloth::ClothSolver::GuardTotals totals = guarded.solver().guardTotals();
  state.counters["ratio"] = median(times[1]) / median(times[0]);
  state.counters["ms"] = 1e3 * median(times[1]);
  state.counters["more_ms"] = 1e3 * (median(times[1]) - median(times[0]));
  state.counters["looks"] = static_cast<double>(totals.looks) / static_cast<double>(times[1].size());
  state.counters["pairs"] =
      totals.looks > 0 ? static_cast<double>(totals.pairs) / static_cast<double>(totals.looks) : 0;
  state.counters["halts"] = static_cast<double>(totals.halts);
}

wetcloth::ClothPatch upright(int side, double lean = 0) {
  wetcloth::ClothPatch patch;
  patch.columns = patch.rows = side;
  patch.origin = btVector3(btScalar(-0.5), btScalar(0.05), 0);
  patch.edgeV = btVector3(0, 1, btScalar(lean));
  return patch;
}

int sideOf(const benchmark::State& state) { return static_cast<int>(state.range(0)); }

void hanging(benchmark::State& state) {
  wetcloth::ClothPatch patch = upright(sideOf(state));
  patch.pinnedEdges = {wetcloth::ClothPatch::Edge::top};
  compare(state, {patch}, false, 60);
}

void swinging(benchmark::State& state) {
  wetcloth::ClothPatch patch = upright(sideOf(state));
  patch.edgeV = btVector3(0, 0, -1);
  patch.pinnedEdges = {wetcloth::ClothPatch::Edge::top};
  compare(state, {patch}, false, 20);
}

void twoLayers(benchmark::State& state) {
  wetcloth::ClothPatch lower = wetcloth_test::levelPatch(sideOf(state), 1);
  wetcloth::ClothPatch upper = lower;
  lower.origin.setY(btScalar(0.02));
  upper.origin.setY(btScalar(0.03));
  upper.origin.setX(upper.origin.x() + btScalar(0.01));
  compare(state, {lower, upper}, true, 60);
}

// A cloth that lies on a box. The ratio is to the same guard without bodies.
void onABox(benchmark::State& state) {
  wetcloth::ClothPatch cloth = wetcloth_test::levelPatch(sideOf(state), 1);
  cloth.origin.setY(btScalar(0.02));
  wetcloth::ClothSolver::Guard bodies;
  bodies.bodies = true;
  compare(state, {cloth}, true, 60, wetcloth::ClothSolver::Guard(), bodies);
}

void heap(benchmark::State& state) { compare(state, {upright(sideOf(state), 0.1)}, true, 120); }

// How the guard's time grows with the nodes: as many small steps as the finest cloth needs to hang smoothly, and a
// thickness that is the same share of an edge, so that each node is near as many parts.
Guard thicknessOfEdge(const benchmark::State& state) {
  wetcloth::ClothSolver::Guard guard;
  guard.thickness = 0.128 / sideOf(state);
  return guard;
}
constexpr int kFine = 40;  // small steps

void growthHanging(benchmark::State& state) {
  wetcloth::ClothPatch patch = upright(sideOf(state));
  patch.pinnedEdges = {wetcloth::ClothPatch::Edge::top};
  compare(state, {patch}, false, 30, std::nullopt, thicknessOfEdge(state), kFine);
}

void growthTwoLayers(benchmark::State& state) {
  wetcloth::ClothPatch lower = wetcloth_test::levelPatch(sideOf(state), 1);
  wetcloth::ClothPatch upper = lower;
  lower.origin.setY(btScalar(0.02));
  upper.origin.setY(btScalar(0.03));
  upper.origin.setX(upper.origin.x() + btScalar(0.01));
  compare(state, {lower, upper}, true, 30, std::nullopt, thicknessOfEdge(state), kFine);
}

BENCHMARK(hanging)->Arg(64)->Arg(128)->Arg(256)->UseManualTime()->Iterations(120)->Unit(benchmark::kMillisecond);
BENCHMARK(swinging)->Arg(64)->Arg(128)->Arg(256)->UseManualTime()->Iterations(120)->Unit(benchmark::kMillisecond);
BENCHMARK(twoLayers)->Arg(64)->Arg(128)->UseManualTime()->Iterations(30)->Unit(benchmark::kMillisecond);
BENCHMARK(onABox)->Arg(64)->Arg(128)->UseManualTime()->Iterations(60)->Unit(benchmark::kMillisecond);
BENCHMARK(heap)->Arg(64)->Arg(128)->UseManualTime()->Iterations(30)->Unit(benchmark::kMillisecond);
BENCHMARK(growthHanging)->Arg(64)->Arg(128)->Arg(256)->UseManualTime()->Iterations(20)->Unit(benchmark::kMillisecond);
BENCHMARK(growthTwoLayers)->Arg(64)->Arg(128)->Arg(256)->UseManualTime()->Iterations(10)->Unit(benchmark::kMillisecond);

}  // namespace
