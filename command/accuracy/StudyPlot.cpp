// SPDX-License-Identifier: Zlib
#include "command/accuracy/StudyPlot.h"

#include "command/plot/Plots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace accuracy {
namespace {

namespace colours = command::plot_colours;

const std::array<const char*, 10> palette = {colours::blue,   colours::red,   colours::green, colours::orange,
                                             colours::purple, colours::black, "#1aa6a6",      "#b5478c",
                                             "#7a7a2c",       "#8c8c8c"};

/// What has blown up would leave the rest no room: it is drawn here, which no error of use comes near.
constexpr double highestDrawn = 1000;

/// An error of nothing at all has no place on a logarithmic axis: it is drawn a decade below the least of the others.
double lowestDrawn(const Study& study) {
  double lowest = 1;
  for (const Point& point : study.points) {
    if (std::isfinite(point.error) && point.error > 0) lowest = std::min(lowest, point.error);
  }
  return lowest / 10;
}

/// Where and how a study's points are drawn.
struct Drawing {
  double lowest;
  Work work;
  bool isCrowded;  ///< so many curves that the labels of their ends would cover each other
};

double timeOf(const Point& point, Work work) {
  return work == Work::queries ? point.nanosecondsPerNodeStep : point.microsecondsPerNodeSecond;
}

std::string labelOf(const Point& point) {
  if (point.error == 0) return point.label + ": none";
  if (point.error > highestDrawn) return point.label + ": blows up";
  return point.label;
}

void addPoint(command::PlotSeries& series, const Point& point, const Drawing& drawing, const std::string& label) {
  series.add(timeOf(point, drawing.work), std::min(point.error > 0 ? point.error : drawing.lowest, highestDrawn));
  series.labels.push_back(label);
}

/// Labels of what is on the front and of the ends of each curve: all of them would cover each other.
void thinLabels(command::PlotSeries& series, const std::vector<bool>& isOnFront, const Drawing& drawing) {
  const std::size_t size = series.labels.size();
  for (std::size_t i = 0; i < size; ++i) {
    const bool isEnd = i == 0 || i + 1 == size;
    if (!isOnFront[i] && (drawing.isCrowded || !isEnd)) series.labels[i].clear();
  }
}

command::PlotSeries frontOf(const Study& study, const Drawing& drawing) {
  std::vector<Point> front;
  for (const Point& point : study.points) {
    if (point.isOnFront) front.push_back(point);
  }
  std::sort(front.begin(), front.end(),
            [](const Point& a, const Point& b) { return a.microsecondsPerNodeSecond < b.microsecondsPerNodeSecond; });
  command::PlotSeries series;
  series.name = "front";
  series.legend = "Pareto front";
  series.mark = command::PlotSeries::Mark::reference;
  series.colour = "#555555";
  for (const Point& point : front) addPoint(series, point, drawing, "");
  return series;
}

}  // namespace

command::Plot plotOf(const Study& study) {
  command::Plot plot;
  plot.name = study.measure.name;
  plot.title = study.measure.title;
  const bool isOfQueries = study.work == Work::queries;
  plot.xColumn = isOfQueries ? "time_ns_per_query" : "time_us_per_node_s";
  plot.yColumn = "error";
  plot.xLabel = isOfQueries ? "time [ns per query]" : "time [us per node and simulated second]";
  plot.yLabel = study.measure.error;
  plot.xScale = plot.yScale = command::Plot::Scale::logarithmic;
  plot.keyPlace = "outside right top vertical";
  const std::vector<std::string> methods = methodsOf(study.points);
  const Drawing drawing = {lowestDrawn(study), study.work, methods.size() > 5};
  plot.series.push_back(frontOf(study, drawing));
  for (const std::string& method : methods) {
    command::PlotSeries series;
    series.name = series.legend = method;
    series.mark = command::PlotSeries::Mark::labelled;
    series.colour = palette[(plot.series.size() - 1) % palette.size()];
    std::vector<bool> isOnFront;
    for (const Point& point : study.points) {
      if (point.method != method || !std::isfinite(point.error)) continue;
      addPoint(series, point, drawing, labelOf(point));
      isOnFront.push_back(point.isOnFront);
    }
    thinLabels(series, isOnFront, drawing);
    plot.series.push_back(std::move(series));
  }
  return plot;
}

}  // namespace accuracy
