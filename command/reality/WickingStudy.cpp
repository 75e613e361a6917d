// SPDX-License-Identifier: Zlib
#include "command/reality/Studies.h"

#include "command/fit/StripHeights.h"

#include <bullet_wetcloth/bullet_wetcloth.h>

#include <algorithm>
#include <cmath>

namespace reality {
namespace {

constexpr double frontResolution = 0.0008;  // [m]

/// The rows of each group of strips that are alike, one after the other.
std::vector<command::MeasuredTable> groupsOf(const command::MeasuredTable& table) {
  std::vector<command::MeasuredTable> groups{table};
  for (const char* const column : {"needles", "fibre", "knit", "series"}) {
    std::vector<command::MeasuredTable> finer;
    for (const command::MeasuredTable& group : groups) {
      std::vector<std::string> seen;
      for (const std::string& word : group.words(column)) {
        if (std::find(seen.begin(), seen.end(), word) != seen.end()) continue;
        seen.push_back(word);
        finer.push_back(group.where(column, word));
      }
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
  return name == "108 nylon flat ID" || name == "108 polyester terry OD" || name == "200 polyester flat ID" ||
         name.find("synthetic") != std::string::npos;
}

Sample stripsOf(const command::MeasuredTable& table) {
  using Allowed = command::MeasuredTable::Allowed;
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
  strips.run = [times = strips.at, highest](double diffusivity) {
    return fit::stripHeights({diffusivity, wetcloth::Seepage::Parameters{}.speed, highest}, times);
  };
  return strips;
}

}  // namespace

Plan planWicking(const std::string& file) {
  Plan plan;
  plan.name = "wicking";
  plan.title = "Height of water in hanging strips of sock knit";
  plan.model = "Immersion, Diffusion and Seepage (its default speed) in a strip that stands in water";
  plan.halves = "of each cloth the earlier half of the readings is fitted, the later half predicted";
  plan.doubt = "standard deviation over the strips, with the 0.8 mm by which the front steps";
  plan.x = {"time_s", "time [s]"};
  plan.y = {"height_m", "height of the front above the water [m]"};
  plan.isOverTime = true;
  plan.parameter = "diffusivity_m2_s";
  plan.start = wetcloth::Diffusion::Parameters{}.warpDiffusivity;
  plan.roughness = fit::stripRoughness;
  for (const command::MeasuredTable& group : groupsOf(command::MeasuredTable(file))) {
    plan.groups.push_back({stripsOf(group)});
  }
  return plan;
}

}  // namespace reality
