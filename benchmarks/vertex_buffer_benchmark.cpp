// SPDX-License-Identifier: Zlib
// Filling a vertex buffer: ours with positions, normals, colour and roughness, and the same two that Bullet's own copy
// has, against that copy, in turns.

#include "benchmarks/BenchCloth.h"

#include <BulletSoftBody/btDefaultSoftBodySolver.h>

#include <benchmark/benchmark.h>

#include <cstddef>
#include <vector>

namespace {

using wetcloth_bench::BenchCloth;
using wetcloth_bench::median;
using wetcloth_bench::secondsOf;

constexpr int kFloats = 10;

void vertexBufferAgainstBullet(benchmark::State& state) {
  BenchCloth cloth(static_cast<int>(state.range(0)));
  cloth.wet().setSaturation(0.5);
  for (int i = 0; i < 5; ++i) cloth.step();
  const int nodes = cloth.body().m_nodes.size();
  std::vector<float> floats(static_cast<std::size_t>(nodes) * kFloats);
  const wetcloth::VertexBuffer all = {floats.data(), nodes, {0, kFloats}, {3, kFloats}, {6, kFloats}, {9, kFloats}};
  wetcloth::VertexBuffer shape = all;
  shape.colour.stride = shape.roughness.stride = 0;
  btDefaultSoftBodySolver solver;
  btCPUVertexBufferDescriptor descriptor(floats.data(), 0, kFloats, 3, kFloats);
  std::vector<double> ours;
  std::vector<double> oursShape;
  std::vector<double> bullets;
  for (auto _ : state) {
    static_cast<void>(_);
    ours.push_back(secondsOf([&] { wetcloth::fillVertexBuffer(cloth.wet(), all); }));
    benchmark::ClobberMemory();
    oursShape.push_back(secondsOf([&] { wetcloth::fillVertexBuffer(cloth.wet(), shape); }));
    benchmark::ClobberMemory();
    bullets.push_back(secondsOf([&] { solver.copySoftBodyToVertexBuffer(&cloth.body(), &descriptor); }));
    benchmark::ClobberMemory();
    state.SetIterationTime(ours.back());
  }
  const double perNode = 1e9 / nodes;
  state.counters["ns_per_node"] = median(ours) * perNode;
  state.counters["shape_ns_per_node"] = median(oursShape) * perNode;
  state.counters["bullet_ns_per_node"] = median(bullets) * perNode;
}

BENCHMARK(vertexBufferAgainstBullet)->UseManualTime()->Unit(benchmark::kMicrosecond)->Arg(32)->Arg(64)->Arg(256);

}  // namespace
