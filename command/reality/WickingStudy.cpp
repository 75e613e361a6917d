// SPDX-License-Identifier: Zlib
#include "command/reality/Studies.h"

#include "command/cli/Errors.h"
#include "command/fit/StripHeights.h"

#include <bullet_wetcloth/bullet_wetcloth.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace reality {
namespace {

constexpr double frontResolution = 0.0008;  // [m]
constexpr double heightOfBalance = 0.1;     // of the default diffusion and seepage [m]

/// Both numbers fitted to this cloth by `wetcloth fit` come to a seepage speed of 8.0e-4 +- 0.6e-4 m/s.
const char* const clothOfSeepage = "108 nylon flat ID";
constexpr double seepageOfThatCloth = 8.0e-4;

/// Seepage's speed [m/s] that goes with a diffusivity [m^2/s].
using SeepageOf = std::function<double(double diffusivity)>;

/// The rows of each group of strips that are alike.
std::vector<command::MeasuredTable> groupsOf(const command::MeasuredTable& table) {
  std::vector<command::MeasuredTable> groups{table};
  for (const char* const column : {"needles", "fibre", "knit", "series"}) {
    std::vector<command::MeasuredTable> finer;
    for (const command::MeasuredTable& group : groups) {
      for (const std::string& word : group.distinct(column)) finer.push_back(group.where(column, word));
    }
    groups = finer;
  }
  return groups;
}

std::string nameOfStrips(const command::MeasuredTable& table) {
  std::string name;
  for (const char* const column : {"needles", "fibre", "knit", "series"}) {
    name += (name.empty() ? "" : " ") + table.words(column).front();
  }
  return name;
}

/// To be seen in a plot, which eighteen could not.
bool isShown(const std::string& name) {
  return name == clothOfSeepage || name == "108 polyester terry OD" || name == "200 polyester flat ID";
}

Sample stripsOf(const command::MeasuredTable& group, const SeepageOf& seepageOf) {
  using Allowed = command::MeasuredTable::Allowed;
  const command::MeasuredTable table = group.sortedBy("time_s");
  Sample strips;
  strips.name = nameOfStrips(table);
  strips.isPlotted = isShown(strips.name);
  table.requireRows(4, "to fit one half and predict the other");
  strips.at = table.increasing("time_s", Allowed::positive);
  strips.measured = table.numbers("height_m", Allowed::positive);
  for (const double deviation : table.numbers("height_sd_m", Allowed::notNegative)) {
    strips.uncertainty.push_back(std::hypot(deviation, frontResolution));
  }
  for (std::size_t i = 0; i < strips.at.size(); ++i) strips.isFitted.push_back(i < (strips.at.size() + 1) / 2);
  const double highest = *std::max_element(strips.measured.begin(), strips.measured.end());
  strips.run = [times = strips.at, highest, seepageOf](double diffusivity) {
    return fit::stripHeights({diffusivity, seepageOf(diffusivity), highest}, times);
  };
  return strips;
}

Plan planOfStrips(const std::string& file, const SeepageOf& seepageOf) {
  Plan plan;
  plan.halves = "of each cloth the earlier half of the readings is fitted, the later half predicted";
  plan.doubt = "standard deviation over the strips, with the 0.8 mm by which the front steps";
  plan.x = {"time_s", "time [s]"};
  plan.y = {"height_m", "height of the front above the water [m]"};
  plan.isOverTime = true;
  plan.parameter = "diffusivity_m2_s";
  plan.start = 5e-5;
  plan.roughness = fit::stripRoughness;
  const command::MeasuredTable table(file);
  table.requireRows(4, "to fit one half and predict the other");
  for (const command::MeasuredTable& group : groupsOf(table)) {
    plan.groups.push_back({stripsOf(group, seepageOf)});
  }
  return plan;
}

}  // namespace

Plan planWicking(const std::string& file) {
  Plan plan = planOfStrips(file, [](double) { return wetcloth::Seepage::Parameters{}.speed; });
  plan.name = "wicking";
  plan.title = "Height of water in hanging strips of sock knit";
  plan.model = "Immersion, Diffusion and Seepage, its default speed of 5e-5 m/s, in a strip that stands in water";
  return plan;
}

Plan planWickingInBalance(const std::string& file) {
  Plan plan = planOfStrips(file, [](double diffusivity) {
    wetcloth::Diffusion::Parameters diffusion;
    diffusion.warpDiffusivity = diffusion.weftDiffusivity = diffusivity;
    return wetcloth::seepageInBalance(diffusion, heightOfBalance).speed;
  });
  plan.name = "wicking_balance";
  plan.title = "The same strips, with a seepage that grows with the diffusivity";
  plan.model = "Immersion, Diffusion and Seepage, whose speed is kept in proportion, so that both balance over 0.1 m";
  return plan;
}

Plan planWickingOfAKnit(const std::string& file) {
  Plan plan = planOfStrips(file, [](double) { return seepageOfThatCloth; });
  plan.name = "wicking_knit";
  plan.title = "The same strips, with the seepage that one of them asks for";
  plan.model = "Immersion, Diffusion and Seepage of 8.0e-4 m/s, which `wetcloth fit` finds for 108 nylon flat ID";
  plan.halves += "; 108 nylon flat ID is left out";
  const auto isThatCloth = [](const std::vector<Sample>& strips) { return strips.front().name == clothOfSeepage; };
  plan.groups.erase(std::remove_if(plan.groups.begin(), plan.groups.end(), isThatCloth), plan.groups.end());
  if (plan.groups.empty()) {
    throw command::InputError(file + ": must have strips of another cloth than " + clothOfSeepage);
  }
  return plan;
}

}  // namespace reality
