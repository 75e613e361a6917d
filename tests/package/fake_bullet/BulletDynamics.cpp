// SPDX-License-Identifier: Zlib
#include "FakeBullet.h"

int btDiscreteDynamicsWorld::stepSimulation(btScalar) { return 0; }
