// SPDX-License-Identifier: Zlib
#pragma once

#include "command/fit/LeastSquares.h"
#include "command/fit/Task.h"

#include <functional>
#include <string>
#include <vector>

namespace reality {

/// What was measured of one cloth, and the model of it.
struct Sample {
  std::string name;
  std::vector<double> at;           ///< of the readings, on the study's first axis
  std::vector<double> measured;     ///< readings
  std::vector<double> uncertainty;  ///< of each, > 0
  std::vector<bool> isFitted;       ///< else predicted
  /// The readings that the model gives, run as a scene runs it.
  std::function<std::vector<double>(double parameter)> run;
  bool isPlotted = true;
};

/// A comparison with measurements that is to be made.
struct Plan {
  std::string name;
  std::string title;
  std::string data;    ///< name of its file in tests/data/measured, without ".csv"
  std::string model;   ///< what is run
  std::string halves;  ///< which readings are fitted, and which predicted
  std::string doubt;   ///< where the readings' uncertainty is from
  fit::Axis x;
  fit::Axis y;
  bool isOverTime = false;                  ///< readings of a sample are one curve
  std::string parameter;                    ///< the one that is fitted, with its unit at the end
  double start;                             ///< of it, > 0
  double roughness = 0.01;                  ///< of the model: see fit::fitLeastSquares()
  std::vector<std::vector<Sample>> groups;  ///< each has a parameter of its own
};

/// What is between the model and some readings.
struct Errors {
  int readings = 0;
  double rootMeanSquare = 0;  ///< in the unit of the readings
  double ofRange = 0;         ///< that, over the range of all readings of the study
  double ofUncertainty = 0;   ///< root mean square of error over uncertainty
  double bias = 0;            ///< mean of model - measured, over the same range
};

struct Group {
  fit::Estimate parameter;
  bool hasConverged = true;                ///< the search for it
  std::vector<std::vector<double>> model;  ///< of each sample, at each reading
  Errors fitted;
  Errors predicted;
};

/// A comparison that was made.
struct Study {
  Plan plan;
  std::vector<Group> groups;  ///< as many as the plan has
  Errors fitted;
  Errors predicted;
};

/// Told how far a study is, [0, 1].
using TellProgress = std::function<void(double fraction)>;

/// Fits the parameter of each group and predicts what was not fitted.
Study carryOut(const Plan& plan, const TellProgress& tell);

}  // namespace reality
