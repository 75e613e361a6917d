// SPDX-License-Identifier: Zlib
// The parts of a step one by one, with warm caches, beside what Bullet takes for the same.

#include "benchmarks/BenchCloth.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace {

using wetcloth_bench::BenchCloth;

const wetcloth::Step kStep = {1.0 / 240, 0, btVector3(0, -10, 0)};

void absorb(benchmark::State& state) {
  BenchCloth cloth(static_cast<int>(state.range(0)));
  wetcloth::Absorption& absorption = cloth.wet().add<wetcloth::Absorption>();
  for (auto _ : state) {
    static_cast<void>(_);
    absorption.apply(cloth.wet(), kStep);
  }
}

void absorbAndCommit(benchmark::State& state) {
  BenchCloth cloth(static_cast<int>(state.range(0)));
  wetcloth::Absorption& absorption = cloth.wet().add<wetcloth::Absorption>();
  for (auto _ : state) {
    static_cast<void>(_);
    absorption.apply(cloth.wet(), kStep);
    cloth.wet().masses().commit(cloth.wet().water());
    cloth.wet().linkConstants().refresh(cloth.wet().masses().inverseMasses());
  }
}

void linkConstants(benchmark::State& state) {
  BenchCloth cloth(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    static_cast<void>(_);
    cloth.wet().linkConstants().refresh();
  }
}

void bulletsLinkConstants(benchmark::State& state) {
  BenchCloth cloth(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    static_cast<void>(_);
    cloth.body().updateLinkConstants();
  }
}

enum class Order { patch, reoptimized, byNode };

void sortLinksByNode(btSoftBody& body) {
  std::vector<std::pair<btSoftBody::Node*, btSoftBody::Node*>> ends;
  for (int k = 0; k < body.m_links.size(); ++k) ends.emplace_back(body.m_links[k].m_n[0], body.m_links[k].m_n[1]);
  std::sort(ends.begin(), ends.end());
  for (int k = 0; k < body.m_links.size(); ++k) {
    body.m_links[k].m_n[0] = ends[static_cast<std::size_t>(k)].first;
    body.m_links[k].m_n[1] = ends[static_cast<std::size_t>(k)].second;
  }
}

// One of Bullet's position iterations over the links.
void bulletsIteration(benchmark::State& state, Order order) {
  BenchCloth cloth(static_cast<int>(state.range(0)));
  btSoftBody& body = cloth.body();
  if (order == Order::reoptimized) btSoftBodyHelpers::ReoptimizeLinkOrder(&body);
  if (order == Order::byNode) sortLinksByNode(body);
  std::vector<double> seconds;
  for (auto _ : state) {
    static_cast<void>(_);
    seconds.push_back(wetcloth_bench::secondsOf([&] { btSoftBody::PSolve_Links(&body, 1, 0); }));
  }
  state.counters["ns_per_link"] = wetcloth_bench::median(seconds) * 1e9 / static_cast<double>(body.m_links.size());
}

void ofSide64(benchmark::internal::Benchmark* each) { each->Unit(benchmark::kMicrosecond)->Arg(64); }
void sizes(benchmark::internal::Benchmark* each) { each->Unit(benchmark::kMicrosecond)->Arg(32)->Arg(64)->Arg(128); }

BENCHMARK(absorb)->Apply(ofSide64)->Iterations(400);
BENCHMARK(absorbAndCommit)->Apply(ofSide64)->Iterations(400);
BENCHMARK(linkConstants)->Apply(ofSide64);
BENCHMARK(bulletsLinkConstants)->Apply(ofSide64);
BENCHMARK_CAPTURE(bulletsIteration, patch, Order::patch)->Apply(sizes);
BENCHMARK_CAPTURE(bulletsIteration, reoptimized, Order::reoptimized)->Apply(sizes);
BENCHMARK_CAPTURE(bulletsIteration, byNode, Order::byNode)->Apply(sizes);

}  // namespace
