// SPDX-License-Identifier: Zlib
#include "command/fall/FallingCloth.h"
#include "command/plot/Plots.h"
#include "command/scene/SoundState.h"
#include "command/timing/Quantile.h"

#include <algorithm>
#include <cstddef>
#include <ctime>
#include <memory>

namespace command {
namespace {

constexpr std::size_t medianFrames = 20;  // frames of which the median counts

/// Of the processor, so that other programs do not count.
double secondsOfFrame(FallingCloth& cloth) {
  const std::clock_t start = std::clock();
  for (int i = 0; i < fallSubstepsPerFrame; ++i) cloth.substep();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// A cloth of one of the paper's wetting values, and what its frames took.
class TimedFall {
 public:
  TimedFall(const FallMode& mode, const FallMode::Case& fallCase)
      : m_cloth(mode, fallCase, WorldKind::softRigid), m_height(mode.defaultHeight) {}

  bool isDown() const { return m_cloth.fallen() >= m_height; }
  void frame() {
    m_window.push_back(secondsOfFrame(m_cloth));
    requireSound(m_cloth.blowUp(), m_cloth.time());
    if (m_window.size() < medianFrames) return;
    m_series.add(m_cloth.time() - 0.5 * medianFrames * fallSubstepsPerFrame * fallSubstep, 1 / median(m_window));
    m_window.clear();
  }
  const PlotSeries& series() const { return m_series; }

 private:
  FallingCloth m_cloth;
  double m_height;
  std::vector<double> m_window;
  PlotSeries m_series;
};

struct ShownSpeed {
  const char* name;  ///< of the case in paper mode
  const char* legend;
  const char* colour;
};

}  // namespace

/// The cloths take turns, frame by frame, so that whatever slows the machine slows all of them.
std::vector<Plot> fpsPlots(const PlotProgress& progress) {
  const ShownSpeed shown[] = {{"dry", "dry (Fig. 17)", plot_colours::red},
                              {"0.093 g", "0.093 g (Fig. 18)", plot_colours::orange},
                              {"0.342 g", "0.342 g", plot_colours::green},
                              {"0.591 g", "0.591 g", plot_colours::purple},
                              {"0.84 g", "0.84 g, saturated (Fig. 20)", plot_colours::blue}};
  const FallMode mode = FallMode::paper();
  std::vector<std::unique_ptr<TimedFall>> falls;
  for (const ShownSpeed& one : shown) {
    const auto isIt = [&](const FallMode::Case& fallCase) { return fallCase.name == one.name; };
    falls.push_back(std::make_unique<TimedFall>(mode, *std::find_if(mode.cases.begin(), mode.cases.end(), isIt)));
  }
  const auto isDown = [](const std::unique_ptr<TimedFall>& fall) { return fall->isDown(); };
  for (int frame = 0; !std::all_of(falls.begin(), falls.end(), isDown); ++frame) {
    for (const auto& fall : falls) {
      if (!fall->isDown()) fall->frame();
    }
    progress(std::min(1.0, frame / 240.0));
  }

  Plot plot;
  plot.name = "fps";
  plot.title = "Frames per second during the fall: 32 x 32 nodes, 4 substeps a frame, without drawing";
  plot.xColumn = "time_s";
  plot.yColumn = "frames_per_s";
  plot.xLabel = "time of the fall [s]";
  plot.yLabel = "frames per second of processor time [1/s]";
  plot.xRange = "[0:4.2]";
  plot.yRange = "[0:*]";
  plot.keyPlace = "bottom right";
  for (std::size_t i = 0; i < falls.size(); ++i) {
    PlotSeries series = falls[i]->series();
    series.name = shown[i].name;
    series.legend = shown[i].legend;
    series.colour = shown[i].colour;
    plot.series.push_back(series);
  }
  return {plot};
}

}  // namespace command
