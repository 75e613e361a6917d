// SPDX-License-Identifier: Zlib
#include "FakeBullet.h"

btQuantizedBvh::btQuantizedBvh() : m_bulletVersion(BT_BULLET_VERSION) {}

btScalar btCollisionShape::getContactBreakingThreshold(btScalar) const { return 0; }
