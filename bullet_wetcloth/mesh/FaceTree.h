// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <BulletSoftBody/btSoftBody.h>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Makes the trees of faces that Bullet collides by, m_fdbvt and m_fdbvnt, for a body of any number of parts, in
/// O(n log n): btSoftBody::initializeFaceTree() never returns for a mesh of several parts, and takes O(faces^2) for one
/// (see MeshReport::bulletBuildsFaceTree()). Call it once links, faces, masses and pins are set and before the first
/// step; Bullet makes its own instead, and hangs, when masses, links or faces are changed after it. A
/// WetClothWorld does all this for the cloths that were added to it and that Bullet would hang on.
WETCLOTH_EXPORT void buildFaceTree(btSoftBody& body);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
