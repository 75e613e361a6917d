// SPDX-License-Identifier: Zlib
#pragma once

#include <algorithm>
#include <cmath>

namespace accuracy {

/// Water that spreads along a line behind a front, ds/dt = (D s^2 s_x)_x: the closed form of Barenblatt (1952), with
/// tau = D t / 3 and exponent 3 of the porous medium equation,
/// s = tau^(-1/4) sqrt(max(0, K - x^2 / (12 tau^(1/2)))).
struct BarenblattSpread {
  static constexpr double diffusivity = 0.01;  ///< D [m^2/s]
  static constexpr double duration = 5;        ///< [s]
  static constexpr double firstTau = 1e-3;     ///< at the start
  static constexpr double firstPeak = 0.9;     ///< saturation in the middle at the start

  /// @param x  from the middle [m]; @param time  from the start [s]
  double saturation(double x, double time) const {
    const double tau = firstTau + diffusivity * time / 3;
    const double peak = firstPeak * firstPeak * std::sqrt(firstTau);
    return std::pow(tau, -0.25) * std::sqrt(std::max(0.0, peak - x * x / (12 * std::sqrt(tau))));
  }
};

}  // namespace accuracy
