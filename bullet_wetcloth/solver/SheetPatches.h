// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <LinearMath/btVector3.h>

#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

struct GuardMesh;

/// A piece of a sheet of triangles, without holes, whose border goes round one of its nodes in one direction, seen
/// along its mean normal. GuardBounds tells from it that the sheet does not meet itself there: see docs/guard.md.
struct SheetPatch {
  std::vector<int> tiles;   ///< that have faces in it, sorted
  std::vector<int> whole;   ///< of them those with all faces in it, sorted
  std::vector<int> border;  ///< nodes, once around, against the clock where normals point to the eye
  int middle = 0;           ///< a node
};

/// For a mesh that is no grid and has its tiles and windings: patches that have each tile, each tile and one next to
/// it, and each tile and all next to it. Where borders cannot be found that go round one way there is none.
/// @param places  of all nodes, as they are when the mesh is made [m]
std::vector<SheetPatch> sheetPatchesOf(const GuardMesh& mesh, const std::vector<btVector3>& places);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
