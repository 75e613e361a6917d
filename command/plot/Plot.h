// SPDX-License-Identifier: Zlib
#pragma once

#include <string>
#include <vector>

namespace command {

/// A curve of a plot.
struct PlotSeries {
  enum class Mark {
    line,
    points,
    labelled,  ///< points on a line, each with its label
    reference  ///< a closed form, a limit: a thin dashed line
  };

  std::string name;    ///< in the CSV file
  std::string legend;  ///< in the picture's key; empty: not there
  Mark mark = Mark::line;
  std::string colour;     ///< "#rrggbb"
  std::vector<double> x;  ///< a gap in the line where it is NaN
  std::vector<double> y;
  std::vector<std::string> labels = {};  ///< one for each point, or none at all

  void add(double abscissa, double ordinate) {
    x.push_back(abscissa);
    y.push_back(ordinate);
  }
};

/// Curves over one axis, with all that a table or a picture of them says.
struct Plot {
  enum class Scale { linear, logarithmic };

  std::string name;  ///< of its files
  std::string title;
  std::string xColumn;  ///< in the CSV file, with the unit at its end: time_s
  std::string yColumn;
  std::string xLabel;  ///< with the unit in brackets: time [s]
  std::string yLabel;
  Scale xScale = Scale::linear;
  Scale yScale = Scale::linear;
  std::string xRange = "[*:*]";  ///< as gnuplot writes it
  std::string yRange = "[*:*]";
  std::string keyPlace = "top right";  ///< as gnuplot writes it
  bool hasEqualAxes = false;           ///< a metre is as long along both
  std::vector<PlotSeries> series;
};

/// The curves one below the other: a row is `series;x;y`, after one that names the columns; `series;x;y;label` when a
/// series has labels.
std::string csvOf(const Plot& plot);

/// What draws the plot from its CSV file in gnuplot, to pictures as SVG and as PNG.
std::string gnuplotScript(const Plot& plot, const std::string& csv, const std::string& svg, const std::string& png);

}  // namespace command
