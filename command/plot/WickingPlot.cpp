// SPDX-License-Identifier: Zlib
#include "command/plot/Plots.h"
#include "command/plot/WickingStrip.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <vector>

namespace command {
namespace {

/// Of examples/scenes/wick_strip.json, in twice the rows.
const WickingStrip::Settings& cottonStrip() {
  static const WickingStrip::Settings settings;
  return settings;
}

WickingStrip stripThatFeels(bool gravity) {
  WickingStrip::Settings settings = cottonStrip();
  settings.feelsGravity = gravity;
  return WickingStrip(settings);
}

/// Of the part above the water [m].
double heightOfStrip() { return cottonStrip().length - cottonStrip().dipped; }

struct Moment {
  double time;  ///< [s]
  const char* legend;
  const char* colour;
};

PlotSeries profileOf(const WickingStrip& strip, const Moment& moment) {
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
    const double height = heightOfStrip() * i / 100;
    series.add(1e3 * height, std::exp(-height / rise));
  }
  return series;
}

/// Evenly spaced on the axis of their plot [s].
std::vector<double> frontTimes() {
  std::vector<double> times{5};
  while (times.back() < 8000) times.push_back(1.12 * times.back());
  return times;
}

/// Where the front of a strip is at these times, until it is at the strip's end.
class FrontRecord {
 public:
  bool isComplete() const { return m_next == m_times.size() || m_isAtTheEnd; }
  /// After each step.
  void note(const WickingStrip& strip) {
    if (isComplete() || strip.time() < m_times[m_next] - cottonStrip().step / 2) return;
    m_isAtTheEnd = strip.front() >= strip.height(strip.rows() - 1);
    if (m_isAtTheEnd) return;
    m_series.add(strip.time(), 1e3 * strip.front());
    ++m_next;
  }
  const PlotSeries& series() const { return m_series; }

 private:
  std::vector<double> m_times = frontTimes();
  std::size_t m_next = 0;
  bool m_isAtTheEnd = false;
  PlotSeries m_series;
};

PlotSeries frontWithoutGravity() {
  WickingStrip strip = stripThatFeels(false);
  FrontRecord record;
  while (!record.isComplete()) {
    strip.advance();
    record.note(strip);
  }
  return record.series();
}

Plot profilePlot(FrontRecord& front, const PlotProgress& progress) {
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
  WickingStrip strip = stripThatFeels(true);
  for (const Moment& moment : moments) {
    while (strip.time() < moment.time - cottonStrip().step / 2) {
      strip.advance();
      front.note(strip);
      progress(strip.time() / std::rbegin(moments)->time);
    }
    plot.series.push_back(profileOf(strip, moment));
  }
  plot.series.push_back(equilibrium());
  return plot;
}

/// x = k sqrt(D t) at s = WickingStrip::frontLevel, without gravity behind an end that is full: k from (s^2 s')' + eta
/// s' / 2 = 0, s(0) = 1, eta = x / sqrt(D t), integrated numerically.
constexpr double washburnFactor = 1.0880;

PlotSeries washburn() {
  PlotSeries series{
      "Washburn", "front as sqrt(t) (Washburn 1921)", PlotSeries::Mark::reference, plot_colours::black, {}, {}};
  for (const double time : frontTimes()) {
    const double height = washburnFactor * std::sqrt(wetcloth::Diffusion::Parameters{}.weftDiffusivity * time);
    if (height > heightOfStrip()) break;
    series.add(time, 1e3 * height);
  }
  return series;
}

Plot frontPlot(PlotSeries upright) {
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
  PlotSeries level = frontWithoutGravity();
  level.name = level.legend = "without gravity";
  level.mark = PlotSeries::Mark::points;
  level.colour = plot_colours::orange;
  upright.name = upright.legend = "upright";
  upright.colour = plot_colours::blue;
  plot.series = {level, upright, washburn()};
  return plot;
}

}  // namespace

std::vector<Plot> wickingPlots(const PlotProgress& progress) {
  std::vector<Plot> plots;
  FrontRecord upright;
  plots.push_back(profilePlot(upright, [&](double fraction) { progress(0.8 * fraction); }));
  plots.push_back(frontPlot(upright.series()));
  progress(1);
  return plots;
}

}  // namespace command
