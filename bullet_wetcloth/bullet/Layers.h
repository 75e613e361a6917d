// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <BulletSoftBody/btSoftBody.h>

#include <array>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// The node numbers of a face.
using FaceNodes = std::array<int, 3>;

/// Those of a body's faces, in their order.
std::vector<FaceNodes> nodesOfFaces(const btSoftBody& body);

/// Whether a face has the three nodes of an earlier one, either way round: the same layer of cloth, once more.
/// O(n log n).
std::vector<bool> areDoubled(const std::vector<FaceNodes>& faces);

/// nodesOfFaces() without the doubled ones: each layer of cloth once.
std::vector<FaceNodes> layersOf(const btSoftBody& body);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
