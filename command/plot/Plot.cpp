// SPDX-License-Identifier: Zlib
#include "command/plot/Plot.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>

namespace command {
namespace {

std::string numberText(double number) {
  if (std::isnan(number)) return "NaN";
  char text[40];
  std::snprintf(text, sizeof text, "%.9g", number);
  return text;
}

/// As a string of gnuplot's that takes everything as it is.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char character : text) result += character == '\'' ? std::string("''") : std::string(1, character);
  return result + "'";
}

std::string styleOf(const PlotSeries& series) {
  const std::string colour = " linecolor rgb " + quoted(series.colour);
  switch (series.mark) {
    case PlotSeries::Mark::line: return "lines linewidth 2.5" + colour;
    case PlotSeries::Mark::labelled: return "linespoints pointtype 7 pointsize 0.8 linewidth 1.2" + colour;
    case PlotSeries::Mark::points: return "points pointtype 7 pointsize 0.9" + colour;
    case PlotSeries::Mark::reference: break;
  }
  return "lines linewidth 1.5 dashtype (8,6)" + colour;
}

std::string curvesOf(const Plot& plot, const std::string& csv) {
  std::string curves;
  for (const PlotSeries& series : plot.series) {
    curves += curves.empty() ? "plot " : ", \\\n     ";
    const std::string rows = quoted(csv) + " skip 1 using (strcol(1) eq " + quoted(series.name) + " ? $2 : NaN):3";
    curves +=
        rows + " with " + styleOf(series) + (series.legend.empty() ? " notitle" : " title " + quoted(series.legend));
    if (series.mark != PlotSeries::Mark::labelled) continue;
    curves += ", \\\n     " + rows + ":4 with labels left offset 0.6,0.4 font ',9' textcolor rgb " +
              quoted(series.colour) + " notitle";
  }
  return curves + "\n";
}

}  // namespace

std::string csvOf(const Plot& plot) {
  const bool hasLabels = std::any_of(plot.series.begin(), plot.series.end(),
                                     [](const PlotSeries& series) { return !series.labels.empty(); });
  std::string text = "series;" + plot.xColumn + ";" + plot.yColumn + (hasLabels ? ";label\n" : "\n");
  for (const PlotSeries& series : plot.series) {
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      text += series.name + ";" + numberText(series.x[i]) + ";" + numberText(series.y[i]);
      if (hasLabels) text += ";" + (series.labels.empty() ? "" : series.labels[i]);
      text += "\n";
    }
  }
  return text;
}

std::string gnuplotScript(const Plot& plot, const std::string& csv, const std::string& svg, const std::string& png) {
  std::string script =
      "set datafile separator ';'\n"
      "set termoption noenhanced\n"
      "set border 3 linecolor rgb '#444444'\nset tics nomirror out textcolor rgb '#222222'\n"
      "set grid linetype 1 linecolor rgb '#e4e4e4' linewidth 0.7\n";
  script += "set title " + quoted(plot.title) + "\n";
  script += "set xlabel " + quoted(plot.xLabel) + "\nset ylabel " + quoted(plot.yLabel) + "\n";
  script += "set xrange " + plot.xRange + "\nset yrange " + plot.yRange + "\n";
  script += "set key " + plot.keyPlace +
            " Left reverse samplen 2.5 spacing 1.2 width -2 box linecolor rgb '#cccccc' opaque\n";
  script += "set format '%g'\n";
  if (plot.xScale == Plot::Scale::logarithmic) script += "set logscale x\n";
  if (plot.yScale == Plot::Scale::logarithmic) script += "set logscale y\n";
  if (plot.hasEqualAxes) script += "set size ratio -1\n";
  const std::string curves = curvesOf(plot, csv);
  script += "set terminal svg noenhanced size 900,560 font 'sans-serif,15' background '#ffffff'\n";
  script += "set output " + quoted(svg) + "\n" + curves + "unset output\n";
  script += "set terminal pngcairo noenhanced size 900,560 font 'sans,12' background '#ffffff'\n";
  script += "set output " + quoted(png) + "\n" + curves + "unset output\n";
  return script;
}

}  // namespace command
