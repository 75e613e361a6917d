// SPDX-License-Identifier: Zlib
#include "command/plot/FallPlot.h"

#include "command/fall/FallingCloth.h"
#include "command/plot/Plots.h"
#include "command/scene/SoundState.h"

#include <algorithm>

namespace command {
namespace {

PlotSeries closedForm(const FallMode& mode, const FallMode::Case& fallCase, const std::string& colour) {
  PlotSeries series;
  series.name = "closed form, " + fallCase.name;
  series.mark = PlotSeries::Mark::reference;
  series.colour = colour;
  const double end = mode.closedForm(fallCase, mode.defaultHeight);
  for (int i = 0; i <= 200; ++i) {
    const double time = end * i / 200;
    series.add(time, std::max(0.0, mode.defaultHeight - mode.closedFormFallen(fallCase, time)));
  }
  return series;
}

struct ShownFall {
  std::string name;  ///< of the mode's case
  std::string legend;
  std::string colour;
};

Plot fallPlot(const FallMode& mode, const std::string& title, const std::vector<ShownFall>& shown) {
  Plot plot;
  plot.name = "fall_" + mode.name;
  plot.title = title;
  plot.xColumn = "time_s";
  plot.yColumn = "height_m";
  plot.xLabel = "time [s]";
  plot.yLabel = "height of the cloth's centre above the floor [m]";
  plot.xRange = "[0:4.2]";
  plot.yRange = "[0:*]";
  for (const auto& [name, legend, colour] : shown) {
    const auto isIt = [&, &wanted = name](const FallMode::Case& fallCase) { return fallCase.name == wanted; };
    const FallMode::Case& fallCase = *std::find_if(mode.cases.begin(), mode.cases.end(), isIt);
    plot.series.push_back(closedForm(mode, fallCase, colour));
    PlotSeries ours = descend(mode, fallCase);
    ours.name = name;
    ours.legend = legend;
    ours.colour = colour;
    plot.series.push_back(ours);
  }
  plot.series.push_back(
      {"", "closed forms", PlotSeries::Mark::reference, plot_colours::black, {}, {}});  // for the key alone
  return plot;
}

}  // namespace

PlotSeries descend(const FallMode& mode, const FallMode::Case& fallCase) {
  PlotSeries series;
  series.mark = PlotSeries::Mark::points;
  FallingCloth cloth(mode, fallCase, WorldKind::softRigid);
  for (int step = 0; cloth.fallen() < mode.defaultHeight; ++step) {
    if (step % 36 == 0) series.add(cloth.time(), mode.defaultHeight - cloth.fallen());  // each 0.15 s
    cloth.substep();
    requireSound(cloth.blowUp(), cloth.time());
  }
  return series;
}

std::vector<Plot> fallPlots(const PlotProgress& progress) {
  const Plot paper =
      fallPlot(FallMode::paper(), "The fall of Fig. 19, paper mode: drag linear in speed, 4 s dry and 2 s saturated",
               {{"bullet", "Bullet alone (no air)", plot_colours::orange},
                {"saturated", "saturated, 84 times the dry mass", plot_colours::blue},
                {"dry", "dry", plot_colours::red}});
  progress(0.5);
  const Plot physical =
      fallPlot(FallMode::physical(), "The fall in physical mode: cotton of 150 g/m², drag quadratic in speed",
               {{"bullet", "Bullet alone (no air)", plot_colours::orange},
                {"4 x dry", "4 times the dry mass", plot_colours::purple},
                {"saturated", "saturated, 1.84 times the dry mass", plot_colours::blue},
                {"dry", "dry", plot_colours::red}});
  progress(1);
  return {paper, physical};
}

}  // namespace command
