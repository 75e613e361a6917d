// SPDX-License-Identifier: Zlib
// How what a cloth takes grows with its nodes, effect by effect: setting up, a step, and memory, each for a node. What
// grows as the nodes do has a row of like numbers; what grows as their square has four times the number before.

#include "benchmarks/BenchCloth.h"

#include <malloc.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace {

using wetcloth_bench::BenchCloth;
using wetcloth_bench::secondsOf;

constexpr int kSmallest = 32;   // nodes along a side
constexpr int kLargest = 1024;  // unless the command line says less
constexpr int kPasses = 3;      // of which the least counts
constexpr int kSteps = 2;       // measured in each pass, after the first
constexpr double kTooLong = 5;  // a set-up that takes longer is not tried on four times the nodes [s]
constexpr double kAsk = std::numeric_limits<double>::infinity();

struct Figures {
  double setUp = kAsk;  ///< adding it and its first step [s]
  double step = kAsk;   ///< [s]
  double bytes = kAsk;  ///< kept

  void keepLeast(const Figures& other) {
    setUp = std::min(setUp, other.setUp);
    step = std::min(step, other.step);
    bytes = std::min(bytes, other.bytes);
  }
};

struct Subject {
  std::string name;
  std::function<Figures(int side)> measure;
};

double bytesInUse() {
  const auto info = mallinfo2();
  return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

/// Of the steps that follow the first, which sets up what is set up once.
double leastOf(BenchCloth& cloth, const std::function<double()>& seconds) {
  double least = kAsk;
  for (int i = 0; i < kSteps; ++i) {
    const double whole = secondsOf([&] { cloth.step(); });
    least = std::min(least, seconds ? seconds() : whole);
  }
  return least;
}

Figures plainBullet(int side) {
  Figures figures;
  const double before = bytesInUse();
  std::unique_ptr<BenchCloth> cloth;
  figures.setUp = secondsOf([&] { cloth = std::make_unique<BenchCloth>(side); });
  figures.setUp += secondsOf([&] { cloth->step(); });
  figures.step = leastOf(*cloth, {});
  figures.bytes = bytesInUse() - before;
  return figures;
}

/// Half full of water, and its hem in water.
std::unique_ptr<BenchCloth> wetCloth(int side) {
  auto cloth = std::make_unique<BenchCloth>(side);
  cloth->body().m_cfg.piterations = 1;  // Bullet's part is not measured here
  btSoftBodyWorldInfo& info = *cloth->body().m_worldInfo;
  info.water_normal = btVector3(0, 0, 1);
  info.water_offset = btScalar(-0.1);
  info.water_density = 1000;
  return cloth;
}

Figures ourPart(int side, const std::function<void(BenchCloth&)>& prepare,
                const std::function<void(BenchCloth&)>& add) {
  const auto cloth = wetCloth(side);
  cloth->step();
  prepare(*cloth);
  Figures figures;
  const double before = bytesInUse();
  figures.setUp = secondsOf([&] { add(*cloth); });
  cloth->step();
  figures.setUp += cloth->ourSeconds();
  figures.step = leastOf(*cloth, [&] { return cloth->ourSeconds(); });
  figures.bytes = bytesInUse() - before;
  return figures;
}

Figures clothAlone(int side) {
  return ourPart(
      side, [](BenchCloth&) {}, [](BenchCloth& cloth) { cloth.wet().setSaturation(0.5); });
}

template <class Effect>
Subject effect(const char* name, const typename Effect::Parameters& parameters = {}) {
  return {name, [parameters](int side) {
            return ourPart(
                side,
                [](BenchCloth& cloth) {
                  cloth.wet().setSaturation(0.5);
                  cloth.step();
                },
                [&](BenchCloth& cloth) {
                  cloth.wet().setPace(wetcloth::WaterPace::exact());
                  cloth.wet().add<Effect>(parameters);
                });
          }};
}

wetcloth::Wind::Parameters breeze() {
  wetcloth::Wind::Parameters parameters;
  parameters.velocity = btVector3(2, 0, 1);
  return parameters;
}

wetcloth::Splash::Parameters jet() {
  wetcloth::Splash::Parameters parameters;
  parameters.region = wetcloth::Splash::Sphere{btVector3(btScalar(0.5), 0, btScalar(0.5)), 0.2};
  parameters.velocity = btVector3(0, -5, 0);
  return parameters;
}

wetcloth::Diffusion::Parameters inSubsteps() {
  wetcloth::Diffusion::Parameters parameters;
  parameters.method = wetcloth::Diffusion::Method::explicitSubsteps;
  return parameters;
}

std::vector<Subject> subjects() {
  return {{"plain Bullet", plainBullet},
          {"a `WetCloth` without effects", clothAlone},
          effect<wetcloth::Absorption>("`Absorption`"),
          effect<wetcloth::Immersion>("`Immersion`"),
          effect<wetcloth::Rain>("`Rain`"),
          effect<wetcloth::Splash>("`Splash`", jet()),
          effect<wetcloth::ContactWetting>("`ContactWetting`"),
          effect<wetcloth::Diffusion>("`Diffusion`"),
          effect<wetcloth::Diffusion>("`Diffusion`, explicit substeps", inSubsteps()),
          effect<wetcloth::Seepage>("`Seepage`"),
          effect<wetcloth::Dripping>("`Dripping`"),
          effect<wetcloth::Drying>("`Drying`"),
          effect<wetcloth::WetStiffness>("`WetStiffness`"),
          effect<wetcloth::Swelling>("`Swelling`"),
          effect<wetcloth::Wind>("`Wind`", breeze()),
          effect<wetcloth::WaterDrag>("`WaterDrag`"),
          effect<wetcloth::Cling>("`Cling`"),
          effect<wetcloth::WetFriction>("`WetFriction`"),
          effect<wetcloth::HookeSprings>("`HookeSprings`"),
          effect<wetcloth::CollisionAudit>("`CollisionAudit`")};
}

using Row = std::vector<Figures>;  // one for each side

/// Shorter than the sides where more nodes would take too long.
Row rowOf(const Subject& subject, const std::vector<int>& sides) {
  Row row;
  for (const int side : sides) {
    if (!row.empty() && row.back().setUp > kTooLong) break;
    row.emplace_back();
    for (int pass = 0; pass < kPasses; ++pass) row.back().keepLeast(subject.measure(side));
  }
  std::cerr << subject.name << " done\n";
  return row;
}

void print(const char* title, const std::vector<Subject>& list, const std::vector<Row>& rows,
           const std::vector<int>& sides, double Figures::*figure, double scale) {
  std::printf("\n| %s |", title);
  for (const int side : sides) std::printf(" %d |", side);
  std::printf("\n|---|");
  for (std::size_t k = 0; k < sides.size(); ++k) std::printf("---|");
  std::printf("\n");
  for (std::size_t i = 0; i < list.size(); ++i) {
    std::printf("| %s |", list[i].name.c_str());
    for (std::size_t k = 0; k < sides.size(); ++k) {
      if (k < rows[i].size()) std::printf(" %.0f |", std::max(0.0, rows[i][k].*figure) * scale / (sides[k] * sides[k]));
      if (k >= rows[i].size()) std::printf(" |");
    }
    std::printf("\n");
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int largest = argc > 1 ? std::atoi(argv[1]) : kLargest;
  if (argc > 2 || largest < kSmallest) {
    std::cerr << "usage: " << argv[0] << " [LARGEST SIDE, at least " << kSmallest << "]\n";
    return 2;
  }
  std::vector<int> sides;
  for (int side = kSmallest; side <= largest; side *= 2) sides.push_back(side);
  const std::vector<Subject> list = subjects();
  std::vector<Row> rows;
  for (const Subject& subject : list) rows.push_back(rowOf(subject, sides));
  print("setting up, ns per node", list, rows, sides, &Figures::setUp, 1e9);
  print("a step, ns per node", list, rows, sides, &Figures::step, 1e9);
  print("memory, bytes per node", list, rows, sides, &Figures::bytes, 1);
  return 0;
}
