// SPDX-License-Identifier: Zlib
#include "command/fit/Task.h"

namespace fit {

const std::vector<std::pair<std::string, MakeTask>>& taskNames() {
  static const std::vector<std::pair<std::string, MakeTask>> names{
      {"absorption", absorptionTask}, {"wicking", wickingTask}, {"drying", dryingTask}, {"stretch", stretchTask}};
  return names;
}

Readings readingsOf(const command::MeasuredTable& table, const std::string& column, const std::string& uncertainty) {
  using Allowed = command::MeasuredTable::Allowed;
  Readings readings;
  readings.values = table.numbers(column, Allowed::notNegative);
  if (table.has(uncertainty)) readings.uncertainties = table.numbers(uncertainty, Allowed::positive);
  return readings;
}

}  // namespace fit
