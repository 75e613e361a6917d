// SPDX-License-Identifier: Zlib
#include "command/fit/StripHeights.h"

#include "command/plot/WickingStrip.h"

#include <algorithm>
#include <cmath>

namespace fit {
namespace {

using command::WickingStrip;

constexpr int stripRows = 101;
constexpr double rowsInWater = 2.01;  // so that water begins right below its surface
constexpr double stepsToTheEnd = 300;
constexpr double stepsToTheFirst = 8;

WickingStrip::Settings settingsOf(const StripTest& test, const std::vector<double>& times) {
  WickingStrip::Settings settings;
  settings.rows = stripRows;
  const double spacing = 2 * test.highest / (stripRows - 1 - rowsInWater);
  settings.dipped = rowsInWater * spacing;
  settings.length = (stripRows - 1) * spacing;
  settings.step = std::min(times.back() / stepsToTheEnd, times.front() / stepsToTheFirst);
  settings.fabric.timeConstant = settings.step / 10;
  // A search may ask for anything.
  settings.diffusion.warpDiffusivity = settings.diffusion.weftDiffusivity = std::clamp(test.diffusivity, 1e-15, 1e3);
  settings.seepage.speed = std::clamp(test.seepageSpeed, 0.0, 1e3);
  return settings;
}

/// Where the square of the saturation goes to 0, read on from the last two rows that are wet: behind a front it is
/// linear (D ~ s^2), so that the front does not jump from row to row.
double frontOf(const WickingStrip& strip) {
  int row = 0;
  while (row + 1 < strip.rows() && strip.saturation(row + 1) >= WickingStrip::frontLevel) ++row;
  if (row + 1 == strip.rows() || row == 0) return strip.height(row);
  const double last = std::pow(strip.saturation(row), 2);
  const double falls = std::pow(strip.saturation(row - 1), 2) - last;
  const double next = strip.height(row + 1);
  return falls > 0 ? std::min(next, strip.height(row) + last / falls * (next - strip.height(row))) : next;
}

}  // namespace

std::vector<double> stripHeights(const StripTest& test, const std::vector<double>& times) {
  WickingStrip strip(settingsOf(test, times));
  std::vector<double> heights;
  double timeBefore = 0, heightBefore = 0;
  for (const double time : times) {
    while (strip.time() < time) {
      timeBefore = strip.time();
      heightBefore = frontOf(strip);
      strip.advance();
    }
    const double share = (time - timeBefore) / (strip.time() - timeBefore);
    heights.push_back(heightBefore + share * (frontOf(strip) - heightBefore));
  }
  return heights;
}

}  // namespace fit
