#include "StudyPlot.h"

#include "../runner/Plots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace accuracy {
namespace {

namespace colours = runner::plot_colours;

const std::array<const char*, 10> palette = {colours::blue,   colours::red,   colours::green, colours::orange,
                                             colours::purple, colours::black, "#1aa6a6",      "#b5478c",
                                             "#7a7a2c",       "#8c8c8c"};

/// An error of nothing at all has no place on a logarithmic axis: it is drawn a decade below the least of the others.
double lowestDrawn(const Study& study) {
  double lowest = 1;
  for (const Point& point : study.points) {
    if (std::isfinite(point.error) && point.error > 0) lowest = std::min(lowest, point.error);
  }
  return lowest / 10;
}

void addPoint(runner::PlotSeries& series, const Point& point, double lowest, const std::string& label) {
  series.add(point.microsecondsPerNodeSecond, point.error > 0 ? point.error : lowest);
  series.labels.push_back(label);
}

/// Labels of what is on the front and of the ends of each curve: all of them would cover each other.
void thinLabels(runner::PlotSeries& series, const std::vector<bool>& isOnFront) {
  for (std::size_t i = 1; i + 1 < series.labels.size(); ++i) {
    if (!isOnFront[i]) series.labels[i].clear();
  }
}

runner::PlotSeries frontOf(const Study& study, double lowest) {
  std::vector<Point> front;
  for (const Point& point : study.points) {
    if (point.isOnFront) front.push_back(point);
  }
  std::sort(front.begin(), front.end(),
            [](const Point& a, const Point& b) { return a.microsecondsPerNodeSecond < b.microsecondsPerNodeSecond; });
  runner::PlotSeries series;
  series.name = "front";
  series.legend = "Pareto front";
  series.mark = runner::PlotSeries::Mark::reference;
  series.colour = "#555555";
  for (const Point& point : front) addPoint(series, point, lowest, "");
  return series;
}

}  // namespace

runner::Plot plotOf(const Study& study) {
  runner::Plot plot;
  plot.name = study.measure.name;
  plot.title = study.measure.title;
  plot.xColumn = "time_us_per_node_s";
  plot.yColumn = "error";
  plot.xLabel = "time [us per node and simulated second]";
  plot.yLabel = study.measure.error;
  plot.xScale = plot.yScale = runner::Plot::Scale::logarithmic;
  plot.keyPlace = "outside right top vertical";
  const double lowest = lowestDrawn(study);
  plot.series.push_back(frontOf(study, lowest));
  for (const std::string& method : methodsOf(study.points)) {
    runner::PlotSeries series;
    series.name = series.legend = method;
    series.mark = runner::PlotSeries::Mark::labelled;
    series.colour = palette[(plot.series.size() - 1) % palette.size()];
    std::vector<bool> isOnFront;
    for (const Point& point : study.points) {
      if (point.method != method || !std::isfinite(point.error)) continue;
      addPoint(series, point, lowest, point.label);
      isOnFront.push_back(point.isOnFront);
    }
    thinLabels(series, isOnFront);
    plot.series.push_back(std::move(series));
  }
  return plot;
}

}  // namespace accuracy
