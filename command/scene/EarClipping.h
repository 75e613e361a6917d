// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <vector>

namespace command {

using Point = std::array<double, 3>;

/// Cuts a polygon into triangles of its corners' numbers, corners - 2 of them: ears are clipped off one after the other
/// (Meisters 1975, "Polygons have ears"), so a concave polygon is covered once. A convex one becomes the fan of its
/// first corner. What is not flat is seen along its mean normal (Newell's); what crosses itself is cut somehow.
/// O(corners^2) for most, O(corners^3) at worst.
/// @param corners  at least 3
std::vector<std::array<int, 3>> clipEars(const std::vector<Point>& corners);

}  // namespace command
