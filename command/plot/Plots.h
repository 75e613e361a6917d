// SPDX-License-Identifier: Zlib
#pragma once

#include "command/plot/Plot.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace command {

/// Told how far a plot's runs are, [0, 1].
using PlotProgress = std::function<void(double fraction)>;

/// Mass of a node against time: the paper's Table II beside its Eq. 2, and ours in both modes.
std::vector<Plot> massPlots(const PlotProgress& progress);
/// Height of the falling cloth against time, dry, wet and in Bullet alone, beside the closed forms: in paper mode and
/// in physical mode.
std::vector<Plot> fallPlots(const PlotProgress& progress);
/// Frames per second during the falls of the paper's Figs. 17, 18 and 20, dry and at its four wetting values.
std::vector<Plot> fpsPlots(const PlotProgress& progress);
/// A strip that dips into water: its saturation over the height, and how high the front is.
std::vector<Plot> wickingPlots(const PlotProgress& progress);

/// The paper's Fig. 9: the springs of a small patch, one colour for each kind.
std::vector<Plot> springsPlots(const PlotProgress& progress);

using MakePlots = std::vector<Plot> (*)(const PlotProgress& progress);

/// By the names that the command knows them by.
const std::vector<std::pair<std::string, MakePlots>>& plotNames();

namespace plot_colours {

inline const char* const black = "#222222";
inline const char* const blue = "#0b6fb8";
inline const char* const red = "#c8321f";
inline const char* const orange = "#e08b00";
inline const char* const green = "#2e8b57";
inline const char* const purple = "#8e6bbf";

}  // namespace plot_colours

}  // namespace command
