// SPDX-License-Identifier: Zlib
#include "FakeBullet.h"

void btSoftBody::setTotalMass(btScalar, bool) {}
