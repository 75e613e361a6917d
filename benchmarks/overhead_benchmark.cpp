// SPDX-License-Identifier: Zlib
// What our effects add to Bullet's own step. `added_percent` is our part of the step over Bullet's part of the same
// steps, by fives, since water moves in one of five. `ratio` is the whole of them over those of a plain cloth, the two
// taking turns so that a machine whose speed drifts slows both; cloths that move differently also cost Bullet
// differently, so it can lie on either side of it.

#include "benchmarks/BenchCloth.h"

#include <benchmark/benchmark.h>

#include <vector>

namespace {

using wetcloth_bench::BenchCloth;
using wetcloth_bench::median;
using wetcloth_bench::secondsOf;

constexpr int kSteps = 5;

wetcloth::Wind::Parameters breeze() {
  wetcloth::Wind::Parameters parameters;
  parameters.velocity = btVector3(2, 0, 1);
  return parameters;
}

// One iteration is five steps of each, in turns; the counters are medians over all iterations.
void compare(benchmark::State& state, BenchCloth& tested, BenchCloth& plain) {
  std::vector<double> ours;
  std::vector<double> shares;
  std::vector<double> ratios;
  bool testedFirst = true;
  for (auto _ : state) {
    static_cast<void>(_);
    double times[2] = {0, 0};
    double added = 0;
    for (int step = 0; step < kSteps; ++step) {
      for (const bool isTested : {testedFirst, !testedFirst}) {
        times[isTested ? 0 : 1] += secondsOf([&] { (isTested ? tested : plain).step(); });
      }
      added += tested.ourSeconds();
      testedFirst = !testedFirst;
    }
    state.SetIterationTime(times[0] / kSteps);
    ours.push_back(added / kSteps);
    shares.push_back(added / (times[0] - added));
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
  tested.wet().add<wetcloth::Wind>(breeze());
  compare(state, tested, plain);
}

void paperSet(benchmark::State& state) {
  BenchCloth tested(side(state));
  BenchCloth plain(side(state));
  tested.wet().add<wetcloth::Absorption>();
  tested.wet().add<wetcloth::Wind>(breeze());
  compare(state, tested, plain);
}

void paperSetOnBulletsPatch(benchmark::State& state) {
  BenchCloth tested(side(state), BenchCloth::Mesh::bullets);
  BenchCloth plain(side(state), BenchCloth::Mesh::bullets);
  tested.wet().add<wetcloth::Absorption>();
  tested.wet().add<wetcloth::Wind>(breeze());
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
  each->UseManualTime()->Unit(benchmark::kMicrosecond)->Iterations(40)->Arg(32)->Arg(64)->Arg(128)->Arg(256);
}

void smallSizes(benchmark::internal::Benchmark* each) {
  each->UseManualTime()->Unit(benchmark::kMicrosecond)->Iterations(40)->Arg(32)->Arg(64);
}

BENCHMARK(noEffects)->Apply(sizes);
BENCHMARK(absorption)->Apply(sizes);
BENCHMARK(wind)->Apply(sizes);
BENCHMARK(paperSet)->Apply(sizes);
BENCHMARK(paperSetOnBulletsPatch)->Apply(smallSizes);
BENCHMARK(saturated)->Apply(sizes);
BENCHMARK(hookeSprings)->Apply(smallSizes);

}  // namespace
