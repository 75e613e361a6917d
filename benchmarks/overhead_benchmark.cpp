// SPDX-License-Identifier: Zlib
// What our effects add to Bullet's own step. `added_percent` is our part of the step over Bullet's part of the same
// step. `ratio` is the whole step over that of a plain cloth, the two taking turns so that a machine whose speed
// drifts slows both; cloths that move differently also cost Bullet differently, so it can lie on either side of it.

#include "benchmarks/BenchCloth.h"

#include <benchmark/benchmark.h>

#include <vector>

namespace {

using wetcloth_bench::BenchCloth;
using wetcloth_bench::median;
using wetcloth_bench::secondsOf;

// One iteration is one step of each; the counters are medians over all of them.
void compare(benchmark::State& state, BenchCloth& tested, BenchCloth& plain) {
  std::vector<double> ours;
  std::vector<double> shares;
  std::vector<double> ratios;
  bool testedFirst = true;
  for (auto _ : state) {
    static_cast<void>(_);
    double times[2];
    for (const bool isTested : {testedFirst, !testedFirst}) {
      times[isTested ? 0 : 1] = secondsOf([&] { (isTested ? tested : plain).step(); });
    }
    testedFirst = !testedFirst;
    state.SetIterationTime(times[0]);
    ours.push_back(tested.ourSeconds());
    shares.push_back(tested.ourSeconds() / (times[0] - tested.ourSeconds()));
    ratios.push_back(times[0] / times[1]);
  }
  state.counters["added_percent"] = 100 * median(shares);
  state.counters["added_ns_per_node"] = median(ours) * 1e9 / static_cast<double>(plain.body().m_nodes.size());
  state.counters["ratio"] = median(ratios);
}

int side(const benchmark::State& state) { return static_cast<int>(state.range(0)); }

void noEffects(benchmark::State& state) {
  BenchCloth tested(side(state));
  BenchCloth plain(side(state));
  tested.wet();
  compare(state, tested, plain);
}

void absorption(benchmark::State& state) {
  BenchCloth tested(side(state));
  BenchCloth plain(side(state));
  tested.wet().add<wetcloth::Absorption>();
  compare(state, tested, plain);
}

void wind(benchmark::State& state) {
  BenchCloth tested(side(state));
  BenchCloth plain(side(state));
  tested.wet().add<wetcloth::Wind>({btVector3(2, 0, 1)});
  compare(state, tested, plain);
}

void paperSet(benchmark::State& state) {
  BenchCloth tested(side(state));
  BenchCloth plain(side(state));
  tested.wet().add<wetcloth::Absorption>();
  tested.wet().add<wetcloth::Wind>({btVector3(2, 0, 1)});
  compare(state, tested, plain);
}

void paperSetOnBulletsPatch(benchmark::State& state) {
  BenchCloth tested(side(state), BenchCloth::Mesh::bullets);
  BenchCloth plain(side(state), BenchCloth::Mesh::bullets);
  tested.wet().add<wetcloth::Absorption>();
  tested.wet().add<wetcloth::Wind>({btVector3(2, 0, 1)});
  compare(state, tested, plain);
}

void saturated(benchmark::State& state) {
  BenchCloth tested(side(state));
  BenchCloth plain(side(state));
  tested.wet().add<wetcloth::Absorption>();
  tested.wet().setSaturation(1);
  compare(state, tested, plain);
}

void hookeSprings(benchmark::State& state) {
  BenchCloth tested(side(state));
  BenchCloth plain(side(state));
  tested.wet().add<wetcloth::HookeSprings>();
  compare(state, tested, plain);
}

void sizes(benchmark::internal::Benchmark* each) {
  each->UseManualTime()->Unit(benchmark::kMicrosecond)->Iterations(100)->Arg(32)->Arg(64)->Arg(128)->Arg(256);
}

void smallSizes(benchmark::internal::Benchmark* each) {
  each->UseManualTime()->Unit(benchmark::kMicrosecond)->Iterations(100)->Arg(32)->Arg(64);
}

BENCHMARK(noEffects)->Apply(sizes);
BENCHMARK(absorption)->Apply(sizes);
BENCHMARK(wind)->Apply(sizes);
BENCHMARK(paperSet)->Apply(sizes);
BENCHMARK(paperSetOnBulletsPatch)->Apply(smallSizes);
BENCHMARK(saturated)->Apply(sizes);
BENCHMARK(hookeSprings)->Apply(smallSizes);

}  // namespace
