// SPDX-License-Identifier: Zlib
#include "command/reality/Studies.h"

#include "command/accuracy/Specimen.h"

#include <algorithm>
#include <cmath>

namespace reality {
namespace {

constexpr double tunnelSpeed = 9;  // the middle one of three [m/s]
constexpr double streamerStep = 1. / 240;
constexpr int settlingSteps = 360;
constexpr int meanSteps = 240;
constexpr double dragDoubt = 0.1;  // of the drag

struct Streamer {
  double width;         ///< [m]
  double length;        ///< [m]
  double arealDensity;  ///< [kg/m^2]
};

accuracy::Specimen::Settings settingsOf(const Streamer& streamer) {
  constexpr int acrossTheWidth = 3, mostAlong = 36;
  accuracy::Specimen::Settings settings;
  settings.world.clothSolver = wetcloth::ClothSolver::Parameters{};
  settings.patch.columns =
      1 + std::min(mostAlong, static_cast<int>(std::lround((acrossTheWidth - 1) * streamer.length / streamer.width)));
  settings.patch.rows = acrossTheWidth;
  settings.patch.edgeU = btVector3(static_cast<btScalar>(streamer.length), 0, 0);
  settings.patch.edgeV = btVector3(0, 0, static_cast<btScalar>(streamer.width));
  settings.patch.arealDensity = streamer.arealDensity;
  settings.patch.pinnedEdges = {wetcloth::ClothPatch::Edge::left};
  return settings;
}

/// Mean pull of the wind over half its pressure [m^2].
double dragAreaOf(const Streamer& streamer, double skinFriction) {
  accuracy::Specimen specimen(settingsOf(streamer));
  wetcloth::Wind::Parameters air;
  air.velocity = btVector3(btScalar(tunnelSpeed), 0, 0);
  air.skinFriction = skinFriction;
  const wetcloth::Wind& wind = specimen.cloth().add<wetcloth::Wind>(air);
  double pull = 0;
  for (int i = 0; i < settlingSteps + meanSteps; ++i) {
    specimen.substep(streamerStep);
    if (i >= settlingSteps) pull += static_cast<double>(wind.totalForce().x()) / meanSteps;
  }
  return pull / (0.5 * air.airDensity * tunnelSpeed * tunnelSpeed);
}

Sample streamersOf(const command::MeasuredTable& table, const std::string& series, bool isFitted) {
  using Allowed = command::MeasuredTable::Allowed;
  const command::MeasuredTable rows = table.where("series", series);
  rows.requireRows(isFitted ? 2 : 1, isFitted ? "to fit 1 number" : "to predict");
  const std::vector<double> widths = rows.numbers("width_m", Allowed::positive);
  const std::vector<double> lengths = rows.numbers("length_m", Allowed::positive);
  const std::vector<double> densities = rows.numbers("areal_density_kg_m2", Allowed::positive);
  Sample sample;
  sample.name = series;
  sample.at = densities;
  sample.measured = rows.numbers("drag_area_m2", Allowed::positive);
  for (const double reading : sample.measured) sample.uncertainty.push_back(dragDoubt * reading);
  sample.isFitted.assign(sample.at.size(), isFitted);
  sample.run = [widths, lengths, densities](double skinFriction) {
    std::vector<double> areas;
    for (std::size_t i = 0; i < widths.size(); ++i) {
      areas.push_back(dragAreaOf({widths[i], lengths[i], densities[i]}, skinFriction));
    }
    return areas;
  };
  return sample;
}

}  // namespace

Plan planStreamers(const std::string& file) {
  const command::MeasuredTable table(file);
  Plan plan;
  plan.name = "streamers";
  plan.title = "Drag of streamers of film and paper in a wind tunnel";
  plan.model = "Wind of 9 m/s, its drag coefficient of 1.2, with ClothSolver; held level along a short edge";
  plan.halves = "the streamers of six materials are fitted, those of the author's own validation predicted";
  plan.doubt = "8 % between two alike, 9.7 % of the author's own fit; 10 % is taken";
  plan.x = {"areal_density_kg_m2", "areal density [kg/m^2]"};
  plan.y = {"drag_area_m2", "drag area [m^2]"};
  plan.parameter = "skin_friction";
  plan.start = 0.01;
  plan.roughness = 0.3;  // a streamer flutters, so that nothing is smooth
  plan.groups = {{streamersOf(table, "material", true), streamersOf(table, "validation", false)}};
  return plan;
}

}  // namespace reality
