// SPDX-License-Identifier: Zlib
#include "command/plot/Plots.h"
#include "command/scene/BlowUp.h"
#include "command/scene/BulletWorld.h"
#include "command/scene/SoundState.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>

namespace command {
namespace {

constexpr double wickingStep = 0.5;  // [s]
constexpr double frontLevel = 0.05;  // saturation at which the front is read
constexpr double stripLength = 0.2;  // [m]
constexpr double dipped = 0.01;      // of it [m]
constexpr double stripSpeed = 1;     // all its nodes are pinned [m/s]

/// The strip of examples/scenes/wick_strip.json, in twice the rows: cotton on a board, its lower end in water.
class Strip {
 public:
  explicit Strip(bool feelsGravity) : m_world(BulletWorld::Settings{}) {
    m_world.worldInfo().water_normal = btVector3(0, 1, 0);
    m_world.worldInfo().water_offset = 0;
    m_world.worldInfo().water_density = 1000;
    m_patch.columns = 2;
    m_patch.rows = 121;
    m_patch.origin = btVector3(btScalar(-0.01), btScalar(-dipped), 0);
    m_patch.edgeU = btVector3(btScalar(0.02), 0, 0);
    m_patch.edgeV = btVector3(0, btScalar(stripLength), 0);
    m_patch.pinnedEdges = {wetcloth::ClothPatch::Edge::left, wetcloth::ClothPatch::Edge::right};
    m_body = &m_world.add(m_patch.build(m_world.worldInfo()));
    m_cloth = &m_world.wet().add(*m_body, wetcloth::Fabric::cotton());
    m_cloth->setPace(wetcloth::WaterPace::exact());
    m_cloth->add<wetcloth::Immersion>();
    m_cloth->add<wetcloth::Diffusion>();
    if (feelsGravity) m_cloth->add<wetcloth::Seepage>();
  }

  double time() const { return static_cast<double>(m_steps) * wickingStep; }
  void advance() {
    m_world.substep(btScalar(wickingStep));
    ++m_steps;
    requireSound(findBlowUp(*m_body, {stripSpeed, wickingStep}), time());
  }
  int rows() const { return m_patch.rows; }
  /// Above the water [m].
  double height(int row) const { return stripLength * row / (m_patch.rows - 1) - dipped; }
  double saturation(int row) const { return m_cloth->saturation(m_patch.node(0, row)); }
  /// Height up to which the strip is wetter than the front is read at, between the rows linear [m].
  double front() const {
    int row = 0;
    while (row + 1 < rows() && saturation(row + 1) >= frontLevel) ++row;
    if (row + 1 == rows()) return height(row);
    const double below = saturation(row);
    const double share = (below - frontLevel) / (below - saturation(row + 1));
    return height(row) + share * (height(row + 1) - height(row));
  }

 private:
  BulletWorld m_world;
  wetcloth::ClothPatch m_patch;
  btSoftBody* m_body = nullptr;
  wetcloth::WetCloth* m_cloth = nullptr;
  long long m_steps = 0;
};

struct Moment {
  double time;  ///< [s]
  const char* legend;
  const char* colour;
};

PlotSeries profileOf(const Strip& strip, const Moment& moment) {
  PlotSeries series;
  series.name = std::to_string(std::lround(moment.time)) + " s";
  series.legend = moment.legend;
  series.colour = moment.colour;
  for (int row = 0; row < strip.rows(); ++row) series.add(1e3 * strip.height(row), strip.saturation(row));
  return series;
}

/// Where wicking up and sinking are equal: D s^2 ds/dy = -v s^3.
PlotSeries equilibrium() {
  PlotSeries series{
      "equilibrium", "equilibrium, s = exp(-v y / D)", PlotSeries::Mark::reference, plot_colours::black, {}, {}};
  const double rise = wetcloth::Diffusion::Parameters{}.weftDiffusivity / wetcloth::Seepage::Parameters{}.speed;
  for (int i = 0; i <= 100; ++i) {
    const double height = (stripLength - dipped) * i / 100;
    series.add(1e3 * height, std::exp(-height / rise));
  }
  return series;
}

Plot profilePlot(const PlotProgress& progress) {
  const Moment moments[] = {{60, "1 min", "#a9d3ee"},
                            {300, "5 min", "#69b0dd"},
                            {1200, "20 min", "#2f86c1"},
                            {5400, "90 min", "#135a93"},
                            {28800, "8 h", "#0a2f57"}};
  Plot plot;
  plot.name = "wicking";
  plot.title = "A strip of cotton that stands in water: its saturation over the height";
  plot.xColumn = "height_mm";
  plot.yColumn = "saturation";
  plot.xLabel = "height above the water [mm]";
  plot.yLabel = "saturation [-]";
  plot.xRange = "[-10:190]";
  plot.yRange = "[0:1.05]";
  Strip strip(true);
  for (const Moment& moment : moments) {
    while (strip.time() < moment.time - wickingStep / 2) {
      strip.advance();
      progress(strip.time() / std::rbegin(moments)->time);
    }
    plot.series.push_back(profileOf(strip, moment));
  }
  plot.series.push_back(equilibrium());
  return plot;
}

/// Evenly spaced on the axis of their plot [s].
std::vector<double> frontTimes() {
  std::vector<double> times{5};
  while (times.back() < 8000) times.push_back(1.12 * times.back());
  return times;
}

PlotSeries frontOf(bool feelsGravity) {
  PlotSeries series;
  Strip strip(feelsGravity);
  for (const double next : frontTimes()) {
    while (strip.time() < next - wickingStep / 2) strip.advance();
    if (strip.front() >= strip.height(strip.rows() - 1)) break;
    series.add(strip.time(), 1e3 * strip.front());
  }
  return series;
}

/// x = k sqrt(D t) at s = frontLevel, without gravity behind an end that is full: k from (s^2 s')' + eta s' / 2 = 0,
/// s(0) = 1, eta = x / sqrt(D t), integrated numerically.
constexpr double washburnFactor = 1.0880;

PlotSeries washburn() {
  PlotSeries series{
      "Washburn", "front as sqrt(t) (Washburn 1921)", PlotSeries::Mark::reference, plot_colours::black, {}, {}};
  for (const double time : frontTimes()) {
    const double height = washburnFactor * std::sqrt(wetcloth::Diffusion::Parameters{}.weftDiffusivity * time);
    if (height > stripLength - dipped) break;
    series.add(time, 1e3 * height);
  }
  return series;
}

Plot frontPlot() {
  Plot plot;
  plot.name = "wicking_front";
  plot.title = "The height at which the strip's saturation is 0.05";
  plot.xColumn = "time_s";
  plot.yColumn = "front_mm";
  plot.xLabel = "time [s]";
  plot.yLabel = "height of the front above the water [mm]";
  plot.xScale = plot.yScale = Plot::Scale::logarithmic;
  plot.xRange = "[5:10000]";
  plot.yRange = "[1:300]";
  plot.keyPlace = "top left";
  PlotSeries level = frontOf(false);
  level.name = level.legend = "without gravity";
  level.mark = PlotSeries::Mark::points;
  level.colour = plot_colours::orange;
  PlotSeries upright = frontOf(true);
  upright.name = upright.legend = "upright";
  upright.colour = plot_colours::blue;
  plot.series = {level, upright, washburn()};
  return plot;
}

}  // namespace

std::vector<Plot> wickingPlots(const PlotProgress& progress) {
  std::vector<Plot> plots;
  plots.push_back(profilePlot([&](double fraction) { progress(0.8 * fraction); }));
  plots.push_back(frontPlot());
  progress(1);
  return plots;
}

}  // namespace command
