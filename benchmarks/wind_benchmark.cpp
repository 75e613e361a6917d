// SPDX-License-Identifier: Zlib
// Our wind per triangle against Bullet's own addAeroForceToFace on the same cloth, in turns.

#include "benchmarks/BenchCloth.h"

#include <benchmark/benchmark.h>

#include <vector>

namespace {

using wetcloth_bench::BenchCloth;
using wetcloth_bench::median;
using wetcloth_bench::secondsOf;

const btVector3 kWind(2, 0, 1);

void bulletAero(btSoftBody& body) {
  for (int f = 0; f < body.m_faces.size(); ++f) body.addAeroForceToFace(kWind, f);
}

void windAgainstBullet(benchmark::State& state) {
  BenchCloth cloth(static_cast<int>(state.range(0)));
  cloth.wet();
  for (int i = 0; i < 5; ++i) cloth.step();
  btSoftBody& body = cloth.body();
  body.m_cfg.kDG = 1;
  body.m_cfg.kLF = btScalar(0.1);
  body.m_cfg.aeromodel = btSoftBody::eAeroModel::F_TwoSided;
  wetcloth::Wind::Parameters parameters;
  parameters.velocity = kWind;
  wetcloth::Wind& wind = cloth.wet().add<wetcloth::Wind>(parameters);
  const wetcloth::Step step = {1.0 / 60, 0, btVector3(0, -10, 0)};
  std::vector<double> ours;
  std::vector<double> bullets;
  for (auto _ : state) {
    static_cast<void>(_);
    ours.push_back(secondsOf([&] { wind.apply(cloth.wet(), step); }));
    bullets.push_back(secondsOf([&] { bulletAero(body); }));
    state.SetIterationTime(ours.back());
    for (int i = 0; i < body.m_nodes.size(); ++i) {
      body.m_nodes[i].m_f.setZero();
      body.m_nodes[i].m_v.setZero();
    }
  }
  const double perFace = 1e9 / static_cast<double>(body.m_faces.size());
  state.counters["ns_per_face"] = median(ours) * perFace;
  state.counters["bullet_ns_per_face"] = median(bullets) * perFace;
  state.counters["ratio"] = median(ours) / median(bullets);
}

BENCHMARK(windAgainstBullet)->UseManualTime()->Unit(benchmark::kMicrosecond)->Arg(32)->Arg(64)->Arg(128)->Arg(256);

}  // namespace
