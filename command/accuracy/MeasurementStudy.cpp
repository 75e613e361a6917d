// SPDX-License-Identifier: Zlib
#include "command/accuracy/Studies.h"
#include "command/measured/MeasuredTable.h"
#include "command/plot/WickingStrip.h"
#include "command/timing/ProcessorTime.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace accuracy {
namespace {

using command::WickingStrip;

constexpr double measuredStripLength = 0.2;  // the water rises to less [m]
constexpr int measuredStripRows = 101;

/// One way to have water rise in a strip. Its diffusivity is what docs/reality.md finds for this cloth by the first
/// half of the readings, so that each does as well as it can; the last has both numbers of `wetcloth fit`.
struct RisingLaw {
  std::string name;
  double diffusivity;  ///< [m^2/s]
  double speed;        ///< of Seepage [m/s]; 0: none
};

std::vector<RisingLaw> risingLaws() {
  const double inBalance = 3.41e-5;
  wetcloth::Diffusion::Parameters diffusion;
  diffusion.warpDiffusivity = diffusion.weftDiffusivity = inBalance;
  return {{"Diffusion alone", 2.74e-5, 0},
          {"Seepage by default", 2.81e-5, wetcloth::Seepage::Parameters{}.speed},
          {"Seepage in balance over 0.1 m", inBalance, wetcloth::seepageInBalance(diffusion, 0.1).speed},
          {"both fitted", 4.1e-5, 8.0e-4}};
}

/// What a strip of this cloth was seen to do.
struct SeenHeights {
  std::vector<double> times;    ///< [s]
  std::vector<double> heights;  ///< [m]
};

SeenHeights seenHeights() {
  const command::MeasuredTable strips = command::MeasuredTable(command::measuredFile("wicking_sock_knits_jasper_2025"))
                                            .where("needles", "108")
                                            .where("fibre", "nylon")
                                            .where("knit", "flat")
                                            .where("series", "ID")
                                            .sortedBy("time_s");
  strips.requireRows(2, "to have a range");
  return {strips.increasing("time_s"), strips.numbers("height_m")};
}

/// Error: root mean square over the range of the heights.
Outcome rise(const SeenHeights& seen, const RisingLaw& law, double step) {
  WickingStrip::Settings settings;
  settings.length = measuredStripLength;
  settings.rows = measuredStripRows;
  settings.step = step;
  settings.fabric.timeConstant = 0.1;  // what is in the water soaks at once
  settings.diffusion.warpDiffusivity = settings.diffusion.weftDiffusivity = law.diffusivity;
  settings.feelsGravity = law.speed > 0;
  settings.seepage.speed = law.speed;
  WickingStrip strip(settings);
  double squares = 0;
  const double start = command::processorTime();
  for (std::size_t i = 0; i < seen.times.size(); ++i) {
    while (strip.time() < seen.times[i] - step / 2) strip.advance();
    squares += std::pow(strip.front() - seen.heights[i], 2);
  }
  const auto [least, most] = std::minmax_element(seen.heights.begin(), seen.heights.end());
  return {{std::sqrt(squares / static_cast<double>(seen.times.size())) / (*most - *least)},
          command::processorTime() - start};
}

}  // namespace

std::vector<Study> studyMeasurement(const Effort& effort, const TellProgress& tell) {
  const SeenHeights seen = seenHeights();
  const std::vector<double> steps =
      effort.isQuick ? std::vector<double>{5} : std::vector<double>{0.1, 0.25, 0.5, 1, 2, 5};
  Plan plan;
  plan.knob = "step [s]";
  plan.timed = "the whole step of a strip on a board, in ten minutes of wicking";
  plan.measures = {{"measurement", "Water that rises in a strip of sock knit, as it was seen to",
                    "root mean square of the height's error, of the range of the heights",
                    "measured heights (docs/reality.md: 108 nylon flat ID), which are known to 2 % of that range"}};
  for (const RisingLaw& law : risingLaws()) {
    Setting curve;
    curve.method = law.name;
    curve.nodes = 2 * measuredStripRows;
    curve.simulatedSeconds = seen.times.back();
    addSteps(plan, curve, steps, [seen, law](double step) { return rise(seen, law, step); });
  }
  std::vector<Study> studies = carryOut(plan, effort, tell);
  for (Study& one : studies) one.orders.clear();  // no step makes a law right
  return studies;
}

}  // namespace accuracy
