// SPDX-License-Identifier: Zlib
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace fit {

/// A number that a fit looks for.
struct Unknown {
  std::string name;  ///< with its unit at the end: time_constant_s
  double start;      ///< > 0
  double usual;      ///< stands in where the data cannot tell it and allow this one, > 0
};

/// What a fit has found of an unknown.
struct Estimate {
  double value = 0;
  double fitted = 0;         ///< the best value, whether the data tell it or not
  double standardError = 0;  ///< 0 when it was not told
  bool isNotLess = false;    ///< half of it is ruled out, whatever the others are
  bool isNotMore = false;    ///< and twice of it
  bool isUsual = false;      ///< not told: this is Unknown::usual

  bool isTold() const { return isNotLess && isNotMore; }
};

struct Fit {
  std::vector<Estimate> estimates;  ///< of the unknowns, in their order
  std::vector<double> model;        ///< at each reading
  /// Chi squared over its degrees of freedom; without stated uncertainties the variance of a reading.
  double reducedChiSquared = 0;
  bool hasConverged = true;  ///< each search that it took; else other values may fit better
};

/// Readings of one quantity.
struct Readings {
  std::vector<double> values;
  std::vector<double> uncertainties;  ///< of each, > 0; empty: all alike, to be told by how they scatter
};

/// The readings that the unknowns' values would give.
using Predict = std::function<std::vector<double>(const std::vector<double>& unknowns)>;

/// Most steps of one search.
inline constexpr int fitSteps = 60;

/// The values, all > 0, with the least sum of squares of (model - reading) / uncertainty, by Levenberg and Marquardt in
/// the values' logarithms.
///
/// Standard errors are those of the linearised model, times the root of reducedChiSquared where that is greater than 1
/// or the uncertainties are not stated. An unknown is told when both half and twice its value, all others fitted anew,
/// raise chi squared by more than 4, or Student's t squared when the uncertainties are not stated: when its interval of
/// 95 % lies within a factor of 2. Of those that are not told, the worst is set to its usual value where that fits as
/// well, else left, and the others are fitted anew.
/// Throws command::InputError when there are no more readings than unknowns; command::RunError when the model gives
/// what is not finite, or chi squared is not.
/// @param roughness  over how much of a logarithm the model is differenced: more than its rounding and its mesh make of
///     it. The search ends when it moves by a thousandth of that, or unfinished after fitSteps steps.
Fit fitLeastSquares(const std::vector<Unknown>& unknowns, const Predict& predict, const Readings& readings,
                    double roughness = 0.01);

}  // namespace fit
