// SPDX-License-Identifier: Zlib
#pragma once

#include "command/fit/LeastSquares.h"
#include "command/measured/MeasuredTable.h"

#include <bullet_wetcloth/Fabric.h>
#include <nlohmann/json.hpp>

#include <functional>
#include <string>
#include <vector>

namespace fit {

/// What the readings are laid out over: an axis of a plot and a column of a file.
struct Axis {
  std::string column;  ///< with the unit at its end: time_s
  std::string label;   ///< with the unit in brackets: time [s]
};

/// Between what and what a number of cloth lies; beyond it, readings are mostly in another unit.
struct ClothRange {
  std::string name;  ///< of a column, whose greatest reading is meant, or of an unknown
  double least;
  double most;
  std::string because;
};

/// Measurements of one kind, and the law that is fitted to them.
struct Task {
  std::string name;  ///< what --of says
  std::string law;   ///< as a formula
  Axis x;
  Axis y;
  std::vector<double> at;  ///< of the readings, on the first axis
  Readings readings;
  std::vector<Unknown> unknowns;
  std::vector<ClothRange> ranges;  ///< those of columns first
  double roughness = 0.01;         ///< of the law: see fitLeastSquares()
  /// The law's readings at other places of the first axis, for a curve; empty: the law needs more than that.
  std::function<std::vector<double>(const std::vector<double>& unknowns, const std::vector<double>& at)> curve;
  Predict predict;
  /// What stands in a cloth of a scene: its "fabric", "effects" and so on.
  std::function<nlohmann::ordered_json(const std::vector<Estimate>& estimates)> cloth;
};

// Each reads its columns and throws InputError as MeasuredTable does. Of the fabric comes what is not measured.

/// time_s, water_kg_kg: water over dry mass of a cloth that soaks. Q = C (1 - exp(-t / theta)).
Task absorptionTask(const command::MeasuredTable& table, const wetcloth::Fabric& fabric);
/// time_s, height_m: of the front in a strip that hangs with its end in water. Diffusion and Seepage, in a scene.
Task wickingTask(const command::MeasuredTable& table, const wetcloth::Fabric& fabric);
/// time_s, water_kg_kg: water over dry mass of a cloth that dries. A constant rate, then one that falls.
Task dryingTask(const command::MeasuredTable& table, const wetcloth::Fabric& fabric);
/// load_n_m, strain and, if the cloth was wet, saturation: load over width of a strip that is pulled. Hooke's law.
Task stretchTask(const command::MeasuredTable& table, const wetcloth::Fabric& fabric);

using MakeTask = Task (*)(const command::MeasuredTable& table, const wetcloth::Fabric& fabric);

/// By the names that --of knows them by.
const std::vector<std::pair<std::string, MakeTask>>& taskNames();

/// The readings of a column, with the uncertainties of the column `uncertainty` if there is one.
Readings readingsOf(const command::MeasuredTable& table, const std::string& column, const std::string& uncertainty);

}  // namespace fit
