// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/state/StateArchive.h"

#include <BulletSoftBody/btSoftBody.h>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

using SoftBodyArray = btAlignedObjectArray<btSoftBody*>;

/// Everything that Bullet carries in a soft body from one substep to the next: nodes, links, faces, pose, clusters, the
/// trees of boxes, and the lists of contacts. Settings (m_cfg, materials, collision flags) are the application's.
/// Throws StateError for bodies with tetrahedra or joints, which are not saved.
/// @param bodies  of the world: contacts may name another one's faces
void transferSoftBody(StateArchive& archive, btSoftBody& body, const SoftBodyArray& bodies);

/// Its lists of contacts.
void transferContacts(StateArchive& archive, btSoftBody& body, const SoftBodyArray& bodies);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
