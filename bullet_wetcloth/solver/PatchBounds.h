// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/GuardMesh.h"
#include "bullet_wetcloth/solver/GuardNodes.h"
#include "bullet_wetcloth/solver/SheetBounds.h"

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Between which vectors the normals of a tile's faces are, each over its face's area when the mesh was made, on all of
/// the expected motion.
/// @param firstNode  of the mesh among all nodes
GuardBox normalsOfTile(const GuardMesh& mesh, int tile, const GuardNodes& nodes, int firstNode);

/// True: this patch of a sheet does not meet itself on any of the expected motion. See docs/guard.md for the proof.
/// @param normals  of each tile: normalsOfTile()
bool cannotMeetItself(const SheetPatch& patch, const GuardBox* normals, const GuardNodes& nodes, int firstNode);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
