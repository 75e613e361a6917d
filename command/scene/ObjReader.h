// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/TriangleMesh.h"

#include <array>
#include <string>

namespace command {

/// Where a mesh is put: scaled, then turned about the axes x, y and z, one after the other, then moved.
struct Placement {
  double scale = 1;
  std::array<double, 3> rotation{0, 0, 0};     ///< [degrees]
  std::array<double, 3> translation{0, 0, 0};  ///< [m]

  std::array<double, 3> operator()(std::array<double, 3> place) const;
};

/// The faces of a Wavefront OBJ file as a cloth: polygons are cut into triangles (clipEars()), vertices in one place
/// become one node, a face that is there twice counts once, one without area is left out; remarks tell which. Groups
/// and lines (`l`) have the names of `g` and `o`, texture coordinates stay per corner; normals, materials and curves
/// are passed over. Throws std::invalid_argument naming the line, the value and what is allowed.
TriangleMesh readObj(const std::string& file, const Placement& placement = {});

}  // namespace command
