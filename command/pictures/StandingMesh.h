// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/FrameSequence.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace pictures {

/// Something of the scenery as triangles, for files that know nothing else.
struct StandingMesh {
  std::string name;  ///< "solid", "ground", "water": not unique
  std::vector<Vector3> vertices;
  std::vector<Vector3> normals;  ///< one per vertex
  std::vector<Triangle> triangles;
  Rgb colour{};
  std::optional<std::size_t> solid = std::nullopt;  ///< number in Scenery::solids; none: it never moves
};

/// The solids, as they are in the first frame, and of each ground and of the water a square that reaches well beyond
/// the cloths of all frames.
std::vector<StandingMesh> standingMeshes(const FrameSequence& sequence);

}  // namespace pictures
