// SPDX-License-Identifier: Zlib
#include "FakeBullet.h"

bool btGeometryUtil::isPointInsidePlanes(const btAlignedObjectArray<btVector3>&, const btVector3&, btScalar) {
  return true;
}
