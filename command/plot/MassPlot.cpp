// SPDX-License-Identifier: Zlib
#include "command/plot/Plots.h"
#include "command/scene/BlowUp.h"
#include "command/scene/BulletWorld.h"
#include "command/scene/SoundState.h"

#include <cmath>

namespace command {
namespace {

constexpr double dryGrams = 0.01;  // of a node in the paper
constexpr double soakedFor = 40;   // [s]
constexpr double massStep = 1.0 / 60;
constexpr double soakSpeed = 1;  // nothing moves the cloth [m/s]

/// The middle node of a level cloth whose nodes weigh 0.01 g, as it takes up water; in grams.
PlotSeries absorb(wetcloth::Fabric fabric, const wetcloth::Absorption::Parameters& absorption, double interval) {
  fabric.arealDensity = 0.010;  // [kg/m^2]: with nodes sqrt(0.001) m apart, 0.01 g each
  BulletWorld::Settings settings;
  settings.gravity = btVector3(0, 0, 0);
  BulletWorld world(settings);
  wetcloth::ClothPatch patch;
  patch.columns = patch.rows = 5;
  const auto side = static_cast<btScalar>(4 * std::sqrt(0.001));
  patch.edgeU = btVector3(side, 0, 0);
  patch.edgeV = btVector3(0, 0, side);
  patch.arealDensity = fabric.arealDensity;
  btSoftBody& body = world.add(patch.build(world.worldInfo()));
  wetcloth::WetCloth& cloth = world.wet().add(body, fabric);
  cloth.setPace(wetcloth::WaterPace::exact());
  cloth.add<wetcloth::Absorption>(absorption);

  const int middle = patch.node(2, 2);
  const int every = static_cast<int>(std::lround(interval / massStep));
  PlotSeries series;
  for (int step = 0; step <= static_cast<int>(std::lround(soakedFor / massStep)); ++step) {
    if (step % every == 0) series.add(step * massStep, 1e3 * (cloth.dryMass(middle) + cloth.held(middle)));
    world.substep(btScalar(massStep));
    requireSound(findBlowUp(body, {soakSpeed, massStep}), (step + 1) * massStep);
  }
  return series;
}

PlotSeries tableII() {
  PlotSeries series{"Table II", "the paper's Table II", PlotSeries::Mark::points, plot_colours::black, {}, {}};
  for (int second = 0; second <= 10; ++second) series.add(second, dryGrams + 0.083 * second);
  return series;
}

PlotSeries equation2(const wetcloth::Fabric& fabric) {
  PlotSeries series{"Eq. 2", "the paper's Eq. 2, 0.84 g per gram", PlotSeries::Mark::reference, plot_colours::black, {},
                    {}};
  for (int i = 0; i <= 200; ++i) {
    const double time = soakedFor * i / 200;
    series.add(time, dryGrams * (1 - fabric.capacity * std::expm1(-time / fabric.timeConstant)));
  }
  return series;
}

}  // namespace

std::vector<Plot> massPlots(const PlotProgress& progress) {
  Plot plot;
  plot.name = "mass";
  plot.title = "Mass of a node that soaks: the paper's table holds 83 times its dry mass, its cotton 0.84 times";
  plot.xColumn = "time_s";
  plot.yColumn = "mass_g";
  plot.xLabel = "time [s]";
  plot.yLabel = "mass of a node [g]";
  plot.yScale = Plot::Scale::logarithmic;
  plot.xRange = "[0:40]";
  plot.yRange = "[0.008:2]";
  plot.keyPlace = "at graph 0.98, graph 0.72 right top";
  PlotSeries paper = absorb(wetcloth::Fabric::tableII(), wetcloth::Absorption::Parameters::paper(), 0.25);
  paper.name = "ours, paper mode";
  paper.legend = "ours, paper mode";
  paper.colour = plot_colours::red;
  progress(0.5);
  PlotSeries physical = absorb(wetcloth::Fabric::cotton(), {}, 2);
  physical.name = "ours, physical mode";
  physical.legend = "ours, physical mode (cotton)";
  physical.mark = PlotSeries::Mark::points;
  physical.colour = plot_colours::blue;
  progress(1);
  plot.series = {paper, tableII(), equation2(wetcloth::Fabric::cotton()), physical};
  return {plot};
}

}  // namespace command
