// SPDX-License-Identifier: Zlib
#pragma once

#include <vector>

namespace fit {

/// A strip whose lower end stands in water, as a test of wicking has it.
struct StripTest {
  double diffusivity;   ///< [m^2/s], > 0
  double seepageSpeed;  ///< [m/s], >= 0
  double highest;       ///< about how high water was seen to rise [m], > 0: the strip is twice as high
};

/// Of the heights: see fitLeastSquares(). The front does not go quite evenly from row to row.
inline constexpr double stripRoughness = 0.2;

/// Heights of the front at these times [m], by the model as a scene runs it. The part in the water soaks at once; the
/// strip's capacity and mass do not matter. What has reached the strip's end stays there.
/// @param times  [s], > 0, each greater than the one before
std::vector<double> stripHeights(const StripTest& test, const std::vector<double>& times);

}  // namespace fit
