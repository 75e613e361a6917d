// SPDX-License-Identifier: Zlib
#include "command/plot/Plots.h"
#include "command/reality/StudyReport.h"

#include <cstddef>

namespace reality {
namespace {

namespace colours = command::plot_colours;
using command::PlotSeries;
using Mark = PlotSeries::Mark;

PlotSeries emptySeries(const std::string& name, Mark mark, const char* colour, const std::string& legend = "") {
  return {name, legend, mark, colour, {}, {}};
}

/// A line where it was fitted, which goes on dashed where it predicts, before it or after.
void addCurve(command::Plot& plot, const Sample& sample, const std::vector<double>& model, const char* colour) {
  PlotSeries readings = emptySeries(sample.name, Mark::points, colour, sample.name);
  PlotSeries fitted = emptySeries(sample.name + ", fitted", Mark::line, colour);
  PlotSeries predicted = emptySeries(sample.name + ", predicted", Mark::reference, colour);
  for (std::size_t i = 0; i < model.size(); ++i) {
    readings.add(sample.at[i], sample.measured[i]);
    const bool isEnd = i > 0 && sample.isFitted[i - 1] != sample.isFitted[i];
    if (isEnd && !sample.isFitted[i]) predicted.add(sample.at[i - 1], model[i - 1]);
    if (isEnd && sample.isFitted[i]) predicted.add(sample.at[i], model[i]);
    (sample.isFitted[i] ? fitted : predicted).add(sample.at[i], model[i]);
  }
  for (const PlotSeries& series : {fitted, predicted, readings}) {
    if (!series.x.empty()) plot.series.push_back(series);
  }
}

void addCurves(command::Plot& plot, const Study& study) {
  const char* const palette[] = {colours::blue,   colours::red,    colours::green,
                                 colours::orange, colours::purple, colours::black};
  std::size_t next = 0;
  for (std::size_t i = 0; i < study.groups.size(); ++i) {
    for (std::size_t k = 0; k < study.groups[i].model.size(); ++k) {
      const Sample& sample = study.plan.groups[i][k];
      if (!sample.isPlotted) continue;
      addCurve(plot, sample, study.groups[i].model[k], palette[next]);
      next = (next + 1) % (sizeof palette / sizeof *palette);
    }
  }
  plot.series.push_back(emptySeries("fitted", Mark::line, colours::black, "model, fitted"));
  plot.series.push_back(emptySeries("predicted", Mark::reference, colours::black, "model, predicted"));
  // Outside of what is seen: only for the key.
  for (PlotSeries* const series : {&plot.series.back(), &plot.series.back() - 1}) series->add(-1, -1);
}

void addPoints(command::Plot& plot, const Study& study) {
  PlotSeries readings = emptySeries("measured", Mark::points, colours::blue, "measured");
  PlotSeries fitted = emptySeries("fitted", Mark::points, colours::orange, "model, fitted");
  PlotSeries predicted = emptySeries("predicted", Mark::points, colours::red, "model, predicted");
  for (std::size_t i = 0; i < study.groups.size(); ++i) {
    for (std::size_t k = 0; k < study.groups[i].model.size(); ++k) {
      const Sample& sample = study.plan.groups[i][k];
      for (std::size_t m = 0; m < sample.at.size(); ++m) {
        readings.add(sample.at[m], sample.measured[m]);
        (sample.isFitted[m] ? fitted : predicted).add(sample.at[m], study.groups[i].model[k][m]);
      }
    }
  }
  plot.series = {fitted, predicted, readings};
}

}  // namespace

command::Plot plotOf(const Study& study) {
  command::Plot plot;
  plot.name = study.plan.name;
  plot.title = study.plan.title;
  plot.xColumn = study.plan.x.column;
  plot.xLabel = study.plan.x.label;
  plot.yColumn = study.plan.y.column;
  plot.yLabel = study.plan.y.label;
  plot.keyPlace = "outside top right";
  plot.xRange = plot.yRange = "[0:*]";
  if (study.plan.isOverTime) {
    addCurves(plot, study);
  } else {
    addPoints(plot, study);
  }
  return plot;
}

}  // namespace reality
