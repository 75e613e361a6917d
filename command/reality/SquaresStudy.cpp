// SPDX-License-Identifier: Zlib
#include "command/reality/FallingSheet.h"
#include "command/reality/Studies.h"

#include <bullet_wetcloth/bullet_wetcloth.h>

namespace reality {
namespace {

constexpr double speedDoubt = 0.05;  // of the speed

}  // namespace

Plan planSquares(const std::string& file) {
  using Allowed = command::MeasuredTable::Allowed;
  const command::MeasuredTable table = command::MeasuredTable(file).sortedBy("area_m2");
  table.requireRows(4, "to fit one half and predict the other");
  Plan plan;
  plan.name = "squares";
  plan.title = "Terminal speed of squares of paper, all of one mass";
  plan.model = "Wind with its drag coefficient of 1.2, in still air; a square falls level";
  plan.halves = "the larger half is fitted, the smaller predicted";
  plan.doubt = "not stated; 5 % is assumed";
  plan.x = {"area_m2", "area [m^2]"};
  plan.y = {"terminal_speed_m_s", "terminal speed [m/s]"};
  plan.isOverTime = true;
  plan.parameter = "mass_kg";
  plan.start = 0.005;
  Sample squares;
  squares.name = "paper";
  squares.at = table.numbers("area_m2", Allowed::positive);
  squares.measured = table.numbers("terminal_speed_m_s", Allowed::positive);
  for (std::size_t i = 0; i < squares.at.size(); ++i) {
    squares.uncertainty.push_back(speedDoubt * squares.measured[i]);
    squares.isFitted.push_back(i >= squares.at.size() - squares.at.size() / 2);
  }
  squares.run = [areas = squares.at](double mass) {
    std::vector<double> speeds;
    for (const double area : areas) {
      speeds.push_back(terminalSpeedOf({area, mass / area, wetcloth::Wind::Parameters{}.dragCoefficient}));
    }
    return speeds;
  };
  plan.groups = {{squares}};
  return plan;
}

}  // namespace reality
