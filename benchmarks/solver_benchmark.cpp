// SPDX-License-Identifier: Zlib
// ClothSolver against Bullet's own solver. `ratio` is a step with ClothSolver, wet (absorption and wind) where it says
// so, over a dry step of Bullet's with 10 iterations, both medians of one run in which four cloths of each take turns,
// so that none finds its nodes in the caches. `largest` and `mean` are the links' stretch after 5 s, ours and Bullet's.

#include "benchmarks/BenchCloth.h"
#include "bullet_wetcloth/numerics/InstructionSet.h"
#include "tests/support/RigidBody.h"
#include "tests/support/TwoThreads.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace {

using wetcloth_bench::median;
using wetcloth_bench::secondsOf;
using wetcloth_test::BodyBuilder;
using wetcloth_test::BodyScene;
using wetcloth_test::WorldKind;

constexpr std::size_t kCloths = 4;

// A cloth of 1 m in the plane y = 0.
wetcloth::ClothPatch patchOf(int side) { return wetcloth_test::levelPatch(side, 1); }

BodyBuilder hanging(int side) {
  wetcloth::ClothPatch patch = patchOf(side);
  patch.pinnedEdges = {wetcloth::ClothPatch::Edge::top};
  return [patch](btSoftBodyWorldInfo& info) { return patch.build(info); };
}

BodyBuilder bulletsPatch(int side) {
  return [side](btSoftBodyWorldInfo& info) {
    std::unique_ptr<btSoftBody> body(btSoftBodyHelpers::CreatePatch(
        info, btVector3(0, 0, 0), btVector3(1, 0, 0), btVector3(0, 0, 1), btVector3(1, 0, 1), side, side, 1 + 2, true));
    body->generateBendingConstraints(2);
    body->setTotalMass(btScalar(0.15));
    return body;
  };
}

// Links along the edges of triangles, and across them for bending.
std::vector<std::pair<int, int>> linksOf(const std::vector<std::array<int, 3>>& triangles) {
  std::map<std::pair<int, int>, std::vector<int>> opposite;
  for (const auto& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = t[k];
      const int b = t[(k + 1) % 3];
      opposite[{std::min(a, b), std::max(a, b)}].push_back(t[(k + 2) % 3]);
    }
  }
  std::vector<std::pair<int, int>> links;
  for (const auto& [edge, corners] : opposite) {
    links.push_back(edge);
    if (corners.size() == 2) links.emplace_back(corners[0], corners[1]);
  }
  return links;
}

// A mesh without rows: places and diagonals at random, nodes numbered by where they lie.
BodyBuilder irregular(int side) {
  return [side](btSoftBodyWorldInfo& info) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> jitter(-0.35, 0.35);
    std::vector<btVector3> places;
    for (int j = 0; j < side; ++j) {
      for (int i = 0; i < side; ++i) {
        places.emplace_back(btScalar((i + jitter(random)) / side), btScalar(0), btScalar((j + jitter(random)) / side));
      }
    }
    std::vector<int> order(places.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<int>(k);
    const auto key = [&](int k) {
      const btVector3& place = places[static_cast<std::size_t>(k)];
      return std::make_pair(static_cast<int>(place.z() * static_cast<btScalar>(side) / 2), place.x());
    };
    std::sort(order.begin(), order.end(), [&](int a, int b) { return key(a) < key(b); });
    std::vector<int> number(order.size());
    std::vector<btVector3> sorted;
    for (std::size_t k = 0; k < order.size(); ++k) {
      number[static_cast<std::size_t>(order[k])] = static_cast<int>(k);
      sorted.push_back(places[static_cast<std::size_t>(order[k])]);
    }
    std::vector<std::array<int, 3>> triangles;
    const auto node = [&](int i, int j) { return number[static_cast<std::size_t>(j * side + i)]; };
    for (int j = 0; j + 1 < side; ++j) {
      for (int i = 0; i + 1 < side; ++i) {
        const int a = node(i, j), b = node(i + 1, j), c = node(i + 1, j + 1), d = node(i, j + 1);
        const bool turned = random() % 2 == 0;
        triangles.push_back(turned ? std::array<int, 3>{a, b, c} : std::array<int, 3>{a, b, d});
        triangles.push_back(turned ? std::array<int, 3>{a, c, d} : std::array<int, 3>{b, c, d});
      }
    }
    const int count = static_cast<int>(sorted.size());
    const std::vector<btScalar> masses(sorted.size(), btScalar(0.15) / static_cast<btScalar>(count));
    auto body = std::make_unique<btSoftBody>(&info, count, sorted.data(), masses.data());
    for (const auto& [a, b] : linksOf(triangles)) body->appendLink(a, b);
    for (const auto& t : triangles) body->appendFace(t[0], t[1], t[2]);
    for (int i = 0; i < side; ++i) body->setMass(node(i, 0), 0);
    btSoftBodyHelpers::ReoptimizeLinkOrder(body.get());
    return body;
  };
}

// One world with a cloth; on ClothSolver or not.
class Cloth {
 public:
  Cloth(const BodyBuilder& builder, bool isOurs, bool isWet, std::unique_ptr<btCollisionShape> ground = nullptr,
        const wetcloth::ClothSolver::Parameters& parameters = {})
      : m_solver(parameters),
        m_scene(WorldKind::softRigid, builder, btVector3(0, -10, 0), isOurs ? &m_solver : nullptr) {
    body().m_cfg.piterations = 10;
    body().getCollisionShape()->setMargin(btScalar(0.01));
    if (isWet) {
      m_wet = std::make_unique<wetcloth::WetClothWorld>(m_scene.world());
      wetcloth::WetCloth& cloth = m_wet->add(body());
      cloth.add<wetcloth::Absorption>();
      wetcloth::Wind::Parameters breeze;
      breeze.velocity = btVector3(2, 0, 1);
      cloth.add<wetcloth::Wind>(breeze);
    }
    if (ground) {
      m_ground = std::make_unique<wetcloth_test::RigidBody>(m_scene.bullet(), std::move(ground), btScalar(0),
                                                            btVector3(0, btScalar(-0.51), 0));
    }
  }

  btSoftBody& body() { return m_scene.body(); }
  void soak(double saturation) {
    m_wet = std::make_unique<wetcloth::WetClothWorld>(m_scene.world());
    m_wet->add(body()).setSaturation(saturation);
  }
  void step() { m_scene.bullet().step(1, btScalar(1) / 60); }

 private:
  wetcloth::ClothSolver m_solver;
  BodyScene m_scene;
  std::unique_ptr<wetcloth_test::RigidBody> m_ground;
  std::unique_ptr<wetcloth::WetClothWorld> m_wet;
};

using Ground = std::unique_ptr<btCollisionShape> (*)();

struct Stretch {
  double largest = 0;
  double mean = 0;
};

Stretch stretchOf(btSoftBody& body) {
  Stretch stretch;
  for (int k = 0; k < body.m_links.size(); ++k) {
    const btSoftBody::Link& link = body.m_links[k];
    const double ratio = static_cast<double>((link.m_n[0]->m_x - link.m_n[1]->m_x).length() / link.m_rl);
    stretch.largest = std::max(stretch.largest, ratio);
    stretch.mean += ratio / body.m_links.size();
  }
  return stretch;
}

void compare(benchmark::State& state, const BodyBuilder& builder, bool isWet, Ground ground = nullptr) {
  std::vector<std::unique_ptr<Cloth>> cloths[2];  // Bullet's, ours
  for (const bool isOurs : {false, true}) {
    for (std::size_t k = 0; k < kCloths; ++k) {
      cloths[isOurs ? 1 : 0].push_back(
          std::make_unique<Cloth>(builder, isOurs, isOurs && isWet, ground ? ground() : nullptr));
    }
  }
  for (int step = 0; step < 60; ++step) {
    for (const auto& side : cloths) {
      for (const auto& cloth : side) cloth->step();
    }
  }
  std::vector<double> times[2];
  for (auto _ : state) {
    static_cast<void>(_);
    for (std::size_t k = 0; k < kCloths; ++k) {
      for (const std::size_t side : {std::size_t(0), std::size_t(1)}) {
        times[side].push_back(secondsOf([&] { cloths[side][k]->step(); }));
      }
    }
    state.SetIterationTime(times[1].back());
  }
  state.counters["ratio"] = median(times[1]) / median(times[0]);
  state.counters["ms"] = 1e3 * median(times[1]);
  const Stretch ours = stretchOf(cloths[1][0]->body());
  const Stretch bullets = stretchOf(cloths[0][0]->body());
  state.counters["largest"] = ours.largest;
  state.counters["mean"] = ours.mean;
  state.counters["bullet_largest"] = bullets.largest;
  state.counters["bullet_mean"] = bullets.mean;
}

int side(const benchmark::State& state) { return static_cast<int>(state.range(0)); }

void dry(benchmark::State& state) { compare(state, hanging(side(state)), false); }
void wet(benchmark::State& state) { compare(state, hanging(side(state)), true); }
void wetOnBaseline(benchmark::State& state) {
  wetcloth::forceInstructionSet(wetcloth::InstructionSet::baseline);
  compare(state, hanging(side(state)), true);
  wetcloth::forceInstructionSet(wetcloth::InstructionSet::avx2);
}
void wetOnBulletsPatch(benchmark::State& state) { compare(state, bulletsPatch(side(state)), true); }
void wetAndIrregular(benchmark::State& state) { compare(state, irregular(side(state)), true); }

BodyBuilder lying(int side) {
  return [side](btSoftBodyWorldInfo& info) { return patchOf(side).build(info); };
}
void onABox(benchmark::State& state) {
  compare(state, lying(side(state)), true, [] { return wetcloth_test::box(2, 0.5, 2); });
}
void onAPlane(benchmark::State& state) {
  compare(state, lying(side(state)), true, []() -> std::unique_ptr<btCollisionShape> {
    return std::make_unique<btStaticPlaneShape>(btVector3(0, 1, 0), btScalar(0.5));
  });
}
void onASphere(benchmark::State& state) {
  compare(state, lying(side(state)), true,
          []() -> std::unique_ptr<btCollisionShape> { return std::make_unique<btSphereShape>(btScalar(0.5)); });
}

// Stretch after 5 s, pinned along the top row, by the number of small steps and of tethers; 0: Bullet with 10
// iterations.
void stretch(benchmark::State& state) {
  wetcloth::ClothSolver::Parameters parameters;
  const bool isOurs = state.range(0) > 0;
  if (isOurs) parameters.smallSteps = static_cast<int>(state.range(0));
  parameters.tethers = static_cast<int>(state.range(1));
  for (auto _ : state) {
    static_cast<void>(_);
    Cloth cloth(hanging(64), isOurs, false, nullptr, parameters);
    const double seconds = secondsOf([&] {
      for (int step = 0; step < 300; ++step) cloth.step();
    });
    const Stretch found = stretchOf(cloth.body());
    state.SetIterationTime(seconds / 300);
    state.counters["largest"] = found.largest;
    state.counters["mean"] = found.mean;
  }
}

// How much further a strip of 64 links that its dry weight stretches by 10 % hangs when it is saturated, over what its
// springs say (1.84), with so many tethers of 1 and 1.2 times its length.
void wetWeight(benchmark::State& state) {
  wetcloth::ClothPatch patch;
  patch.columns = 2;
  patch.rows = 65;
  patch.edgeU = btVector3(btScalar(1.0 / 64), 0, 0);
  patch.edgeV = btVector3(0, 1, 0);
  patch.pinnedEdges = {wetcloth::ClothPatch::Edge::top};
  const auto hangs = [&](double saturation) {
    wetcloth::ClothSolver::Parameters parameters;
    parameters.stiffness = 0.15 / 64 * 10 / 2 / 0.1 * 64 / 4;
    parameters.smallSteps = 20;
    parameters.tethers = static_cast<int>(state.range(0));
    parameters.tetherScale = static_cast<double>(state.range(1)) / 100;
    Cloth cloth([&](btSoftBodyWorldInfo& info) { return patch.build(info); }, true, false, nullptr, parameters);
    cloth.body().m_cfg.kDP = btScalar(0.02);
    cloth.soak(saturation);
    for (int step = 0; step < 1200; ++step) cloth.step();
    return -static_cast<double>(cloth.body().m_nodes[0].m_x.y());
  };
  for (auto _ : state) {
    static_cast<void>(_);
    double dry = 0;
    double wet = 0;
    state.SetIterationTime(secondsOf([&] {
      dry = hangs(0);
      wet = hangs(1);
    }));
    state.counters["dry_percent"] = 100 * dry;
    state.counters["wet_percent"] = 100 * wet;
    state.counters["wet_over_dry"] = wet / dry;
  }
}

// One thread over two, in turns.
void twoThreads(benchmark::State& state) {
  wetcloth_test::TwoThreads scheduler;
  Cloth cloth(hanging(side(state)), true, false);
  for (int step = 0; step < 10; ++step) cloth.step();
  std::vector<double> one;
  std::vector<double> two;
  for (auto _ : state) {
    static_cast<void>(_);
    one.push_back(secondsOf([&] { cloth.step(); }));
    btSetTaskScheduler(&scheduler);
    two.push_back(secondsOf([&] { cloth.step(); }));
    btSetTaskScheduler(nullptr);
    state.SetIterationTime(two.back());
  }
  state.counters["times"] = median(one) / median(two);
}

void sizes(benchmark::internal::Benchmark* each) {
  each->UseManualTime()->Unit(benchmark::kMicrosecond)->Iterations(60)->Arg(32)->Arg(64)->Arg(128)->Arg(256);
}
void middle(benchmark::internal::Benchmark* each) {
  each->UseManualTime()->Unit(benchmark::kMicrosecond)->Iterations(60)->Arg(64);
}

BENCHMARK(dry)->Apply(sizes);
BENCHMARK(wet)->Apply(sizes);
BENCHMARK(wetOnBaseline)->Apply(sizes);
BENCHMARK(wetOnBulletsPatch)->Apply(middle);
BENCHMARK(wetAndIrregular)->UseManualTime()->Unit(benchmark::kMicrosecond)->Iterations(60)->Arg(100);
BENCHMARK(onABox)->Apply(middle);
BENCHMARK(onAPlane)->Apply(middle);
BENCHMARK(onASphere)->Apply(middle);
BENCHMARK(twoThreads)->UseManualTime()->Unit(benchmark::kMicrosecond)->Iterations(100)->Arg(64)->Arg(128)->Arg(256);
BENCHMARK(stretch)->UseManualTime()->Unit(benchmark::kMicrosecond)->Iterations(1)->Apply([](auto* each) {
  for (const int smallSteps : {0, 4, 8, 10, 16, 20}) each->Args({smallSteps, 0});
  for (const int tethers : {1, 2}) each->Args({4, tethers});
});
BENCHMARK(wetWeight)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(1)->Apply([](auto* each) {
  each->Args({0, 100});
  each->Args({1, 100});
  each->Args({1, 120});
});

}  // namespace
