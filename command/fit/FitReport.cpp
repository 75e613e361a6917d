// SPDX-License-Identifier: Zlib
#include "command/fit/FitReport.h"

#include "command/fit/FitResiduals.h"
#include "command/fit/FitWarnings.h"
#include "command/plot/Plots.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace fit {
namespace {

using Json = nlohmann::ordered_json;
namespace colours = command::plot_colours;

/// What the data do not say of an unknown; empty when they tell it.
std::string remarkOn(const Estimate& estimate) {
  if (estimate.isTold()) return "";
  char bound[80] = "";
  if (estimate.isNotLess) std::snprintf(bound, sizeof bound, ", only that it is more than %.2g", estimate.fitted / 2);
  if (estimate.isNotMore) std::snprintf(bound, sizeof bound, ", only that it is less than %.2g", estimate.fitted * 2);
  return std::string("the data cannot tell it") + bound +
         (estimate.isUsual ? "; the usual value stands here, and the others hold with it"
                           : "; this value fits, the usual one does not, and the others hold with it");
}

double rangeOf(const std::vector<double>& values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return *most - *least;
}

double rounded(double number) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", number);
  return std::strtod(text, nullptr);
}

/// All its numbers with as many digits as anybody has measured.
Json rounded(Json json) {
  if (json.is_number_float()) return rounded(json.get<double>());
  if (json.is_structured()) {
    for (Json& part : json) part = rounded(part);
  }
  return json;
}

command::PlotSeries seriesOf(const std::string& name, command::PlotSeries::Mark mark, const char* colour,
                             const std::vector<double>& x, const std::vector<double>& y) {
  return {name, name, mark, colour, x, y};
}

std::vector<double> evenly(double last) {
  std::vector<double> places;
  for (int i = 1; i <= 100; ++i) places.push_back(last * i / 100);
  return places;
}

std::vector<double> valuesOf(const Fit& fit) {
  std::vector<double> values;
  for (const Estimate& estimate : fit.estimates) values.push_back(estimate.value);
  return values;
}

command::PlotSeries lawOf(const Task& task, const Fit& fit) {
  using Mark = command::PlotSeries::Mark;
  if (!task.curve) return seriesOf("law, fitted", Mark::points, colours::orange, task.at, fit.model);
  const std::vector<double> places = evenly(task.at.back());
  return seriesOf("law, fitted", Mark::line, colours::orange, places, task.curve(valuesOf(fit), places));
}

command::Plot plotOver(const Task& task, const std::string& suffix, const std::string& title) {
  command::Plot plot;
  plot.name = "fit_" + task.name + suffix;
  plot.title = title;
  plot.xColumn = task.x.column;
  plot.xLabel = task.x.label;
  plot.yColumn = task.y.column;
  plot.yLabel = task.y.label;
  plot.keyPlace = "outside top right";
  return plot;
}

}  // namespace

Json jsonOf(const Task& task, const Fit& fit) {
  Json parameters = Json::array();
  for (std::size_t i = 0; i < task.unknowns.size(); ++i) {
    const Estimate& estimate = fit.estimates[i];
    Json parameter{{"name", task.unknowns[i].name}, {"value", estimate.value}, {"is_told", estimate.isTold()}};
    if (estimate.standardError > 0) parameter["standard_error"] = estimate.standardError;
    if (!estimate.isTold()) parameter["remark"] = remarkOn(estimate);
    parameters.push_back(parameter);
  }
  const std::vector<double> residuals = residualsOf(task, fit);
  return {{"of", task.name},
          {"law", task.law},
          {"readings", task.at.size()},
          {"parameters", parameters},
          {"converged", fit.hasConverged},
          {"warnings", warningsOf(task, fit)},
          {"residual_rms", rootMeanSquare(residuals)},
          {"residual_rms_of_range", rootMeanSquare(residuals) / rangeOf(task.readings.values)},
          {"reduced_chi_squared", task.readings.uncertainties.empty() ? Json() : Json(fit.reducedChiSquared)},
          {task.x.column, task.at},
          {"residuals", residuals},
          {"cloth", rounded(task.cloth(fit.estimates))}};
}

std::string textOf(const Task& task, const Fit& fit) {
  std::string text = task.name + ", " + std::to_string(task.at.size()) + " readings: " + task.law + "\n";
  char line[400];
  for (std::size_t i = 0; i < task.unknowns.size(); ++i) {
    const Estimate& estimate = fit.estimates[i];
    std::snprintf(line, sizeof line, "  %-22s %-10.4g", task.unknowns[i].name.c_str(), estimate.value);
    text += line;
    if (estimate.standardError > 0) {
      std::snprintf(line, sizeof line, " +- %.2g (one standard error)", estimate.standardError);
      text += line;
    }
    const std::string remark = remarkOn(estimate);
    text += (remark.empty() ? "" : " " + remark) + "\n";
  }
  const double rms = rootMeanSquare(residualsOf(task, fit));
  std::snprintf(line, sizeof line, "  residuals: root mean square %.3g", rms);
  text += line;
  if (const double range = rangeOf(task.readings.values); range > 0) {
    std::snprintf(line, sizeof line, ", %.2g %% of the readings' range", 100 * rms / range);
    text += line;
  }
  if (!task.readings.uncertainties.empty()) {
    std::snprintf(line, sizeof line, "; chi squared %.2g for each degree of freedom", fit.reducedChiSquared);
    text += line;
  }
  for (const std::string& warning : warningsOf(task, fit)) text += "\n  warning: " + warning;
  return text + "\n\nFor a cloth of a scene:\n" + rounded(task.cloth(fit.estimates)).dump(2) + "\n";
}

std::vector<command::Plot> plotsOf(const Task& task, const Fit& fit) {
  using Mark = command::PlotSeries::Mark;
  command::Plot plot = plotOver(task, "", task.law);
  plot.series = {lawOf(task, fit),
                 seriesOf("readings, measured", Mark::points, colours::blue, task.at, task.readings.values)};
  const double last = *std::max_element(task.at.begin(), task.at.end());
  command::Plot residuals = plotOver(task, "_residuals", "What the fit leaves: measured less fitted");
  residuals.series = {seriesOf("0", Mark::reference, colours::black, {0, last}, {0, 0}),
                      seriesOf("measured less fitted", Mark::points, colours::blue, task.at, residualsOf(task, fit))};
  return {plot, residuals};
}

}  // namespace fit
